// SPDX-License-Identifier: GPL-3.0-or-later
// Opens pages in headless Chromium, and notes what a page must not do.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import puppeteer from "puppeteer-core";

export const [regulus, chromium, source, work] = ["REGULUS", "CHROMIUM", "SOURCE_DIR", "WORK_DIR"].map(
  (name) => process.env[name],
);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

export async function inBrowser(use) {
  const browser = await puppeteer.launch({
    executablePath: chromium,
    args: ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  try {
    await use(browser);
  } finally {
    await browser.close();
  }
}

/** Runs regulus report and returns the file. A model without a proof ends with 2. */
export const makePage = (name, words) => made(name, ["report", ...words, "-o"]);

/** The page that --page of a question makes. */
export const pageOf = (name, words) => made(name, [...words, "--page"]);

/** Runs a command with the file of a page as its last word. */
function made(name, words) {
  const file = `${work}/${name}.html`;
  try {
    execFileSync(regulus, [...words, file, "--quiet"], { stdio: ["ignore", "pipe", "pipe"] });
  } catch (error) {
    assert.ok(error.status === 1 || error.status === 2, String(error.stderr));
  }
  return file;
}

/** Opens a page; `faults` collects its requests, messages and errors. */
export async function open(browser, file, { width = 1200, scheme = "light", scripts = true } = {}) {
  const page = await browser.newPage();
  const faults = [];
  page.on("console", (message) => faults.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
  page.on("dialog", (dialog) => (faults.push("a dialog"), dialog.dismiss()));
  page.on("request", (request) => {
    if (request.url() !== `file://${file}`) faults.push(`request: ${request.url()}`);
  });
  await page.setJavaScriptEnabled(scripts);
  await page.setViewport({ width, height: 900 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
  await page.goto(`file://${file}`);
  return { page, faults };
}

/** Waits for the second proof and returns its line. */
export async function secondProof(page) {
  await page.waitForFunction(
    () => {
      const line = document.getElementById("again");
      return document.body.classList.contains("damaged") || (line.textContent !== "" && line.className !== "working");
    },
    { timeout: 120000 },
  );
  return page.$eval("#again", (line) => line.textContent);
}

export const textOf = (page, selector) => page.$eval(selector, (element) => element.textContent);

/** Fails if axe-core finds something. */
export async function requireAccessible(page, what) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document));
  const words = violations.map((v) => `${v.id}: ${v.nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`);
  assert.deepEqual(words, [], what);
}

/** Two frames, after which the page has drawn what an event changed. */
export const drawn = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
