// SPDX-License-Identifier: GPL-3.0-or-later
// node build.mjs OUTPUT: checks the types, bundles the program and puts it into one HTML file.
import { createHash } from "node:crypto";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { build } from "esbuild";

const output = process.argv[2];
execFileSync(process.execPath, ["node_modules/typescript/bin/tsc", "--noEmit"], { stdio: "inherit" });

const bundle = async (entry) => {
  const result = await build({
    entryPoints: [entry],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "ascii",
    legalComments: "none",
    write: false,
    logLevel: "warning",
  });
  return result.outputFiles[0].text;
};

const licence = readFileSync("node_modules/three/LICENSE", "utf8").trim();
const program = (await bundle("src/main.ts")).replaceAll("</script", "<\\/script").trim();
const style = (await bundle("src/style.css")).trim();
const sha256 = createHash("sha256").update(program, "utf8").digest("base64");
const pieces = { LICENCE: licence, STYLE: style, PROGRAM: program, PROGRAM_HASH: sha256 };
const page = readFileSync("src/page.html", "utf8").replace(/%([A-Z_]+)%/g, (whole, name) => pieces[name] ?? whole);
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, page);
