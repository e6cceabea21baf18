// SPDX-License-Identifier: GPL-3.0-or-later
// A page of every robot of the library, and of an imported arm: it opens without a request or a message,
// and says what it has proved again.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, statSync } from "node:fs";
import { basename } from "node:path";
import { inBrowser, makePage, open, pageOf, regulus, requireAccessible, secondProof, source, textOf, work } from "./browser.mjs";

mkdirSync(work, { recursive: true });
const imported = `${work}/imported.toml`;
execFileSync(regulus, ["import", `${source}/tests/support/robots/kr16_2.urdf`, "-o", imported], { stdio: "ignore" });
const library = readdirSync(`${source}/models`).filter((name) => name.endsWith(".toml"));
const models = [...library.map((name) => `${source}/models/${name}`), imported];

/** The motions of a model. */
function motionsOf(model) {
  const listed = JSON.parse(execFileSync(regulus, ["list", model, "--json"], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
  return listed.motions;
}

await inBrowser(async (browser) => {
  let failed = 0;
  for (const path of models) {
    const model = basename(path);
    const { name: motion, parameters, waypoints } = motionsOf(path)[0];
    const isPlace = parameters.length === 0 && waypoints === null; // its solutions are asked for
    try {
      const words = [path, motion, "--time-limit", "20"];
      const file = isPlace ? pageOf(model, ["solve", ...words]) : makePage(model, words);
      const start = performance.now();
      const { page, faults } = await open(browser, file, { width: failed % 2 ? 390 : 1200 });
      const opened = performance.now() - start;
      const again = await secondProof(page);
      const verdict = await textOf(page, "#verdict");
      assert.match(verdict, isPlace ? /^COMPLETE: / : /^(NO SINGULARITY|SINGULARITY|POSSIBLE PROBLEM)$/);
      await requireAccessible(page, model);
      assert.deepEqual(faults, []);
      assert.ok(statSync(file).size <= 1.5e6);
      await page.screenshot({ path: `${work}/${model}.png`, fullPage: true });
      console.log(`ok      ${model} ${motion}: ${verdict}; ${again}; opened in ${opened.toFixed(0)} ms, ${(statSync(file).size / 1000).toFixed(0)} kB`);
      await page.close();
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${model} ${motion}\n${error.message}`);
    }
  }
  process.exitCode = failed > 0 ? 1 : 0;
});
