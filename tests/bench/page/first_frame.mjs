// SPDX-License-Identifier: GPL-3.0-or-later
// node first_frame.mjs PACKAGES CHROMIUM PAGE: prints the median time in ms from the start of the
// navigation until the robot and all parts of the page have been drawn.
import { createRequire } from "node:module";

const [packages, executablePath, page] = process.argv.slice(2);
const { default: puppeteer } = await import(createRequire(`${packages}/`).resolve("puppeteer-core"));
const browser = await puppeteer.launch({
  executablePath,
  args: ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const times = [];
try {
  for (let i = 0; i < 6; ++i) {
    const tab = await browser.newPage();
    await tab.setViewport({ width: 1200, height: 900 });
    await tab.goto(`file://${page}`, { waitUntil: "load" });
    const drawn = await tab.evaluate(
      () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())))),
    );
    if (i > 0) times.push(drawn); // the first one warms the browser
    await tab.close();
  }
} finally {
  await browser.close();
}
times.sort((a, b) => a - b);
console.log(times[Math.floor(times.length / 2)].toFixed(1));
