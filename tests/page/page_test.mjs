// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of two robots: what they show is what the program computed, and a damaged page says so.
// PART PARTS: runs every PARTS-th of the tests, from number PART on.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { drawn, inBrowser, makePage, open, pageOf, regulus, requireAccessible, secondProof, source, textOf, work } from "./browser.mjs";

mkdirSync(work, { recursive: true });
const robot = `${source}/models/robot_1.toml`;
const planar = `${source}/models/planar_3rpr.toml`;

const tests = [];
const test = (name, run) => tests.push({ name, run });

const safe = makePage("safe", [robot, "wide_15"]);
const paved = makePage("paved", [planar, "crossing", "--paving"]);

test("A page makes no request and no message, and proves its verdict again", async (browser) => {
  const { page, faults } = await open(browser, safe);
  assert.equal(await textOf(page, "#verdict"), "NO SINGULARITY");
  assert.equal(await secondProof(page), "RE-PROVED IN THIS BROWSER: 3 of 3 boxes");
  assert.equal(await page.$eval("#verdict", (line) => line.className), "no-singularity");
  await requireAccessible(page, "light");
  assert.deepEqual(faults, []);
});

/** Anchors and pose as the model file and the paper write them. */
function platformPoints([x, y, z, psi, theta, phi]) {
  const anchors = [[-3, 7, 0], [3, 7, 0], [7, -1, 0], [4, -6, 0], [-4, -6, 0], [-7, -1, 0]];
  const turnZ = (a, [u, v, w]) => [Math.cos(a) * u - Math.sin(a) * v, Math.sin(a) * u + Math.cos(a) * v, w];
  const turnX = (a, [u, v, w]) => [u, Math.cos(a) * v - Math.sin(a) * w, Math.sin(a) * v + Math.cos(a) * w];
  return anchors.map((b) => turnZ(psi, turnX(theta, turnZ(phi, b))).map((value, i) => value + [x, y, z][i]));
}

test("Sliders move the robot to where the model says", async (browser) => {
  const { page, faults } = await open(browser, safe);
  const ranges = [[-15, 15], [-15, 15], [45, 50], ...Array(3).fill([-Math.PI / 12, Math.PI / 12])];
  for (const steps of [[0, 1000, 250, 900, 100, 500], [730, 20, 999, 1, 640, 1000]]) {
    const points = await page.evaluate((values) => {
      document.querySelector("#points").open = true;
      values.forEach((value, k) => {
        const slider = document.getElementById(`slider-${k}`);
        slider.value = value;
        slider.dispatchEvent(new Event("input"));
      });
      return [...document.querySelectorAll("#points tbody tr")].map((row) =>
        [...row.cells].slice(1).map((cell) => Number(cell.textContent)));
    }, steps);
    const expected = platformPoints(steps.map((step, k) => ranges[k][0] + ((ranges[k][1] - ranges[k][0]) * step) / 1000));
    assert.equal(points.length, 12);
    expected.forEach((point, i) =>
      point.forEach((value, axis) => assert.ok(Math.abs(points[6 + i][axis] - value) < 1e-4, `B${i + 1}: ${points[6 + i]} and ${point}`)));
  }
  assert.deepEqual(faults, []);
});

/** The boxes that `regulus locate` writes; it ends with 1 for a singularity. */
function locatedBoxes() {
  const file = `${work}/boxes.jsonl`;
  try {
    execFileSync(regulus, ["locate", planar, "crossing", "--output", file, "--quiet"], { stdio: "pipe" });
  } catch (error) {
    assert.equal(error.status, 1);
  }
  return readFileSync(file, "utf8").trim().split("\n").map((line) => JSON.parse(line)).filter((line) => line.kind);
}

test("The colours of a slice are the claims of locate", async (browser) => {
  const boxes = locatedBoxes();
  const { page, faults } = await open(browser, paved);
  await secondProof(page);
  await page.click("#samples"); // hatching is on top of the boxes
  await drawn(page);
  const phi = 0.5484247464138107; // the page shows the witness
  const seen = new Set();
  for (let i = 0; i < 80; ++i) {
    const x = -2 + 6 * ((i * 0.618034 + 0.013) % 1);
    const y = 13 + 5 * ((i * 0.414214 + 0.007) % 1);
    const here = boxes.filter(({ box }) =>
      [[x, box.x], [y, box.y], [phi, box.phi]].every(([value, [lo, hi]]) => lo <= value && value <= hi));
    const classes = await page.evaluate(([u, v]) => {
      const svg = document.querySelector(".main-slice svg");
      svg.scrollIntoView({ block: "center" });
      const { x, y } = new DOMPoint(400 * u, 400 * v).matrixTransform(svg.getScreenCTM());
      return document.elementFromPoint(x, y).getAttribute("class");
    }, [(x + 2) / 6, 1 - (y - 13) / 5]);
    const kinds = here.map(({ kind }) => `box ${kind}`);
    assert.ok(kinds.includes(classes), `${classes} at ${x}, ${y}; expected ${kinds}`);
    seen.add(classes);
  }
  assert.ok(seen.has("box free") && seen.has("box singular"), [...seen].join());
  assert.deepEqual(faults, []);
});

test("The colours of a slice are the leaves of the certificate", async (browser) => {
  const model = `${work}/half.toml`;
  writeFileSync(model, `${readFileSync(planar, "utf8")}
[motion.half]
x = [-2, 4]
y = [13, 18]
phi = ["-15*deg", "60*deg"]
constraints = ["phi + (x - 1)/100"]
`);
  const proof = `${work}/half.txt`;
  execFileSync(regulus, ["check", model, "half", "--certificate", proof, "--quiet"], { stdio: "pipe" });
  const tree = readFileSync(proof, "utf8").split("\nproof\n")[1].trim().split("\n").map((line) => line.split(" "));
  /** A double as C99 writes it in hexadecimal, or a decimal. */
  const double = (text) => {
    const [, sign, whole, digits, exponent] = /^(-?)0x([01])\.?([0-9a-f]*)p([+-]\d+)$/.exec(text) ?? [];
    if (whole === undefined) return Number(text);
    return Number(`${sign}1`) * (Number(whole) + parseInt(digits || "0", 16) / 16 ** digits.length) * 2 ** Number(exponent);
  };
  /** The rule of the leaf that holds a point, by the lines s BOX VARIABLE X and l BOX RULE. */
  const ruleAt = (point) => {
    let box = 0;
    let next = 1;
    for (const [kind, id, word, at] of tree)
      if (kind === "s") {
        if (Number(id) === box) box = point[Number(word)] < double(at) ? next : next + 1;
        next += 2;
      } else if (kind === "l" && Number(id) === box) return word;
    throw new Error("no leaf");
  };
  const { page, faults } = await open(browser, makePage("half", [model, "half"]));
  await secondProof(page);
  await page.select("#axis-across", "2"); // phi, and y up
  await page.click("#samples"); // hatching is on top of the boxes
  await drawn(page);
  const seen = new Set();
  for (let i = 0; i < 40; ++i) {
    const [u, v] = [(i * 0.618034 + 0.013) % 1, (i * 0.414214 + 0.007) % 1];
    const shown = await page.evaluate(([a, b]) => {
      const svg = document.querySelector(".main-slice svg");
      svg.scrollIntoView({ block: "center" });
      const { x, y } = new DOMPoint(400 * a, 400 * (1 - b)).matrixTransform(svg.getScreenCTM());
      return document.elementFromPoint(x, y).getAttribute("class");
    }, [u, v]);
    const rule = ruleAt([1, 13 + 5 * v, (-15 + 75 * u) * (Math.PI / 180)]);
    assert.equal(shown, rule === "outside" ? "box outside" : "box free", `${u}, ${v}`);
    seen.add(shown);
  }
  assert.equal(seen.size, 2);
  assert.deepEqual(faults, []);
});

/** A cart at (x, 0, -y) on cables from (0, 0, 0) and (4, 0, 0), singular at y = 0 alone. */
function cart(points) {
  writeFileSync(`${work}/way.csv`, `t,x,y\n${points.map((p, i) => `${i},${p}\n`).join("")}`);
  writeFileSync(`${work}/cart.toml`, `regulus = 1
name = "cart on two cables"
[pose]
x = "m"
y = "m"
[matrix]
rows = [["x", "y"], ["x - 4", "y"]]
[drawing]
points = { A = [0, 0, 0], B = [4, 0, 0], P = ["x", 0, "-y"] }
legs = [["A", "P"], ["B", "P"]]
[motion.way]
waypoints = "way.csv"
`);
  return `${work}/cart.toml`;
}

test("A robot moves along its way-points, and each segment is proved again", async (browser) => {
  const points = [[1, 1], [2, 1.5], [3, 1], [2, 0.5], [1, 1]];
  const { page, faults } = await open(browser, makePage("way", [cart(points)]), { width: 390 });
  assert.equal(await secondProof(page), "RE-PROVED IN THIS BROWSER: 4 of 4 boxes");
  await requireAccessible(page, "way");
  assert.ok((await page.evaluate(() => document.scrollingElement.scrollWidth)) <= 390);
  assert.equal((await page.$$("#segments tbody tr")).length, 4);
  for (const u of [0, 0.25, 1.5, 2.99, 4]) {
    const shown = await page.evaluate((value) => {
      document.querySelector("#points").open = true;
      const slider = document.getElementById("slider-0");
      slider.value = String(100 * value);
      slider.dispatchEvent(new Event("input"));
      return [...document.querySelectorAll("#points tbody tr")].map((row) => [...row.cells].slice(1).map((cell) => Number(cell.textContent)));
    }, u);
    const k = Math.min(Math.floor(u), 3);
    const [x, y] = [0, 1].map((i) => points[k][i] + (u - k) * (points[k + 1][i] - points[k][i]));
    [x, 0, -y].forEach((value, axis) => assert.ok(Math.abs(shown[1][axis] - value) < 1e-5, `${u}: ${shown[1]}`));
  }
  await page.click("#segments tbody tr:nth-child(3) button");
  assert.match(await textOf(page, ".sliders output"), /^segment 3, t = 2.5/);
  assert.deepEqual(faults, []);
});

test("A way into a singularity shows it, and what is certified beside it", async (browser) => {
  const { page, faults } = await open(browser, makePage("bad_way", [cart([[1, 1], [2, 1.5], [3, 1], [2, -0.5]]), "--paving"]));
  assert.match(await secondProof(page), /^RE-PROVED IN THIS BROWSER: the determinant has certain, opposite signs/);
  assert.match(await textOf(page, ".sliders output"), /^segment 3, t = 2.667/);
  const classes = await page.$$eval(".way-strip rect", (boxes) => boxes.map((box) => box.getAttribute("class")));
  assert.ok(classes.includes("box free") && classes.some((name) => name !== "box free"), classes.join());
  assert.deepEqual(faults, []);
});

test("A segment says which part of it has which claim", async (browser) => {
  const { page, faults } = await open(browser, pageOf("stretches", ["locate", cart([[1, 1], [2, 1.5], [3, 1], [2, -0.5]])]));
  const claims = await page.$$eval("#segments tbody tr", (rows) => rows.map((row) => row.lastElementChild.textContent));
  assert.deepEqual(claims.slice(0, 2), Array(2).fill("certified: no singularity"));
  const [, begin, end] = /^certified: no singularity; except from ([\d.]+) to ([\d.]+): certified: holds a singularity$/.exec(claims[2]).map(Number);
  assert.ok(begin < 2 + 2 / 3 && 2 + 2 / 3 < end && end - begin < 0.01, claims[2]);
  assert.equal(await page.$$eval(".legend .dashed", (keys) => keys[0].parentElement.textContent), "dashed: det as sampled, not proved; the line is 0");
  assert.equal((await page.$$(".legend .sampled")).length, 0);
  const widths = await page.$$eval(".way-strip .singular", (boxes) => boxes.map((box) => Number(box.getAttribute("width"))));
  assert.ok(widths.length === 1 && widths[0] >= 3, widths.join());
  assert.match(await textOf(page, ".sliders output"), /^segment 3, t = 2.667/); // the singular pose
  assert.deepEqual(faults, []);
});

test("A page of a margin says what grows, and in which unit", async (browser) => {
  const motion = [robot, "table4_1"];
  const cases = [
    [["--tolerance", "base,platform=0:0.5"], /Uncertainbase, platform: ±v, v from 0 cm to 0\.5 cm\.$/],
    [["--tolerance", "base=0:", "--tolerance", "platform=0.001"], /Uncertainbase: ±v, v from 0 cm on; platform ±0\.001 cm \(18 quantities\)\.$/],
    [["--tube", "x,y=0:0.5"], /Uncertaincontrol error of x, y: ±v, v from 0 cm to 0\.5 cm\.$/],
    [["--scale", "0:1"], /each range times v, v from 0 to 1\.Uncertainnothing: geometry and control are taken as exact\.$/],
    [["--grow", "x=0:1"], /the range of x grows with v, v from 0 cm to 1 cm\.Uncertainnothing/],
  ];
  for (const [words, asked] of cases) {
    const { page, faults } = await open(browser, pageOf("growing", ["margin", ...motion, ...words, "--gap", "0.9"]));
    assert.match(await textOf(page, "#asked"), asked);
    assert.equal(await secondProof(page), "Quoted: this page has no proof of this answer.");
    assert.match(await textOf(page, "main"), /(Proved at [\d.]+( cm)?: |Nothing is proved)/);
    assert.doesNotMatch(await textOf(page, "main"), words[0] === "--scale" ? /^$/ : /(Proved at|At) [\d.]+:/);
    assert.deepEqual(faults, []);
  }
});

test("No page of the manual scrolls sideways on a phone", async (browser) => {
  const manual = join(dirname(regulus), "../share/doc/regulus/manual");
  const pages = existsSync(manual) ? readdirSync(manual).filter((name) => name.endsWith(".html")) : [];
  for (const name of pages) { // none without cmark-gfm
    const { page } = await open(browser, join(manual, name), { width: 375 });
    assert.ok((await page.evaluate(() => document.scrollingElement.scrollWidth)) <= 375, name);
    await page.close();
  }
});

test("Legs have the colours of their forces, by a bound in the page", async (browser) => {
  const file = pageOf("force", ["bound", robot, "wide_15", "force", "--range", "x=0:1", "--range", "y=0:1", "--gap", "0.5"]);
  const { page, faults } = await open(browser, file);
  assert.match(await textOf(page, ".leg-legend"), /^proved bound of the force.* N$/);
  assert.deepEqual(faults, []);
});

/** Where the bars of a page end, in shares of their room, and what stands beside them. */
const barsOf = (page) =>
  page.$$eval(".bar", (all) => all.map((bar) => {
    const { width } = bar.getBoundingClientRect();
    const [solid, open] = [".solid-bar", ".open-bar"].map((name) => bar.querySelector(name).getBoundingClientRect().width / width);
    return { solid, open, label: bar.previousSibling.textContent, text: bar.nextSibling.textContent };
  }));

test("Bars have a scale for each unit, and their words are whole", async (browser) => {
  const file = pageOf("errors", ["bound", robot, "table4_1", "error", "--gap", "0.9"]);
  const { page, faults } = await open(browser, file);
  const { components } = JSON.parse(await page.$eval("#data", (data) => data.textContent)).report;
  assert.deepEqual([...new Set(components.map(({ unit }) => unit))], ["cm", "rad"]);
  const shown = new Map((await barsOf(page)).map((bar) => [bar.label, bar]));
  for (const { label, unit, attained, proved } of components) {
    const largest = Math.max(...components.filter((other) => other.unit === unit).map((other) => other.proved ?? other.attained));
    assert.ok(Math.abs(shown.get(label).solid - attained / largest) < 0.01, label);
    assert.ok(Math.abs(shown.get(label).open - (proved - attained) / largest) < 0.01, label);
    assert.match(shown.get(label).text, new RegExp(` ${unit}$`));
  }
  await requireAccessible(page, "bars");
  assert.deepEqual(faults, []);
  const long = `${work}/long_units.html`;
  writeFileSync(long, forged(file, (data) =>
    [data.report, ...data.bounds].forEach((bound) => bound.components.forEach((c, i) =>
      Object.assign(c, { unit: i % 2 ? "rad/(N*mm*deg)" : "mm", label: `${c.label} of a long name`, attained: -1.2345678e-12, proved: 1.2345678e-7 })))));
  for (const width of [1200, 390]) {
    const { page: forgedPage } = await open(browser, long, { width });
    const hidden = await forgedPage.$$eval(".bar-label, .bar-text", (texts) => texts.filter((text) => {
      const region = text.closest(".scroll");
      const end = text.getBoundingClientRect().right - region.getBoundingClientRect().left + region.scrollLeft;
      return end > region.scrollWidth + 1 || text.scrollWidth > text.clientWidth + 1;
    }).map((text) => text.textContent));
    assert.deepEqual(hidden, [], String(width));
    assert.ok((await barsOf(forgedPage)).every(({ text, solid }) => solid === 0 && /(mm|deg\))$/.test(text)));
  }
});

test("A bar ends where the knowledge does, and a margin has its unit", async (browser) => {
  const page = async (name, change) => {
    const file = `${work}/${name}.html`;
    writeFileSync(file, forged(makePage("margins", [robot, "table4_1", "--margin", "base=0:", "--gap", "0.9"]), change));
    return (await barsOf((await open(browser, file)).page))[0];
  };
  assert.match((await page("margin_unit", () => {})).text, /^[\d.]+ … [\d.]+ cm$/);
  const only = await page("margin_open", (data) => (data.margins[0].refuted = null));
  assert.match(only.text, /^at least [\d.]+ cm$/);
  const none = await page("margin_unknown", (data) => Object.assign(data.margins[0], { certified: null, refuted: null }));
  assert.deepEqual([none.text, none.solid, none.open], ["nothing known", 0, 1]);
  const negative = await page("margin_negative", (data) => Object.assign(data.margins[0], { certified: -4, refuted: -1 }));
  assert.ok(Math.abs(negative.solid - 0.25) < 0.01 && Math.abs(negative.open - 0.75) < 0.01, JSON.stringify(negative));
});

test("Limits, margins and loads are told in their own words, and quoted", async (browser) => {
  const orthoglide = `${source}/models/orthoglide.toml`;
  const { page } = await open(browser, pageOf("limit", ["bound", orthoglide, "cube", "sigma-min", "--limit", "0.4"]));
  assert.match(await textOf(page, "main"), /least singular value.*WITHIN; the limit is/);
  assert.match(await secondProof(page), /^Quoted: this page has no proof/);
  const { page: grown, faults } = await open(browser, pageOf("margin", ["margin", orthoglide, "factors_2", "--grow", "edge=0:", "--quantity", "sigma-max", "--limit", "2", "--gap", "0.5"]));
  assert.match(await textOf(grown, "main"), /range of edge: WITHIN UP TO .*Proved at .*: the limit holds at every pose. At .*: it is exceeded at some pose/s);
  await requireAccessible(grown, "margin");
  assert.deepEqual(faults, []);
  const { page: load, faults: none } = await open(browser, pageOf("load", ["check", `${source}/models/cable_8.toml`, "hall", "--load", "weight"]));
  assert.equal(await textOf(load, "#verdict"), "FEASIBLE");
  assert.deepEqual(none, []);
});

test("A closure is quoted, with its proof to save, and with slices of its paving", async (browser) => {
  const bars = `${source}/models/four_bar.toml`;
  const { page, faults } = await open(browser, pageOf("closure", ["check", bars, "inside"]));
  assert.equal(await textOf(page, "#verdict"), "NO SINGULARITY");
  assert.match(await secondProof(page), /^Quoted: this page does not run the proof that it has/);
  assert.match(await textOf(page, "main"), /the branch has exactly one configuration.*Save proof.txt/s);
  assert.match(await textOf(page, "main"), /regulus verify proof.txt/);
  await requireAccessible(page, "closure");
  assert.deepEqual(faults, []);
  const { page: boxes, faults: none } = await open(browser, pageOf("branch", ["locate", bars, "turn"]));
  const classes = await boxes.$$eval(".main-slice rect.box", (marks) => marks.map((mark) => mark.getAttribute("class")));
  assert.ok(classes.includes("box free") && classes.includes("box undecided"), classes.join());
  assert.equal(await boxes.$$eval(".sampled, .sample-curve", (marks) => marks.length), 0);
  assert.match(await secondProof(boxes), /^Quoted: this page does not run the proof that it has/);
  assert.match(await textOf(boxes, "main"), /free: the branch has exactly one configuration, and its 2×2 matrix/);
  assert.match(await textOf(boxes, "main"), /regulus locate .*regulus verify proof.txt.*Save proof.txt/s);
  assert.deepEqual(none, []);
  const table = `${work}/crank.csv`;
  writeFileSync(table, "theta\n0\n1\n-1\n-2.5\n0\n");
  writeFileSync(table.replace("crank", "short"), "theta\n0\n1\n");
  const { page: way, faults: still } = await open(browser, pageOf("branch_way", ["check", bars, "turn", "--waypoints", table]));
  assert.equal(await textOf(way, "#verdict"), "SINGULARITY");
  assert.match(await secondProof(way), /^Quoted: this page does not run the proof that it has/);
  assert.deepEqual(await way.$$eval(".way-strip rect", (marks) => marks.map((mark) => mark.getAttribute("class"))), ["box free", "box undecided"]);
  assert.equal(await way.$$eval(".sampled, .sample-curve", (marks) => marks.length), 0);
  assert.match(await textOf(way, ".sliders output"), /^segment 3/);
  assert.match(await textOf(way, "#segments"), /4 segments/);
  await requireAccessible(way, "branch_way");
  assert.deepEqual(still, []);
  const { page: paved, faults: calm } = await open(browser, pageOf("branch_stretches", ["locate", bars, "turn", "--waypoints", table]));
  assert.deepEqual(await paved.$$eval(".way-strip rect", (marks) => marks.map((mark) => mark.getAttribute("class"))), ["box free", "box undecided"]);
  assert.match(await secondProof(paved), /^Quoted: this page does not run the proof that it has/);
  assert.match(await textOf(paved, "main"), /regulus locate .*regulus verify proof.txt.*Save proof.txt/s);
  assert.deepEqual(calm, []);
  const { page: wide, faults: mute } = await open(browser, pageOf("branch_margin", ["margin", bars, "swing", "--waypoints", table.replace("crank", "short"), "--tube", "theta=0:2"]));
  assert.match(await textOf(wide, "main"), /SAFE UP TO/);
  assert.deepEqual(mute, []);
  const { page: errors, faults: quiet } = await open(browser, pageOf("finite", ["bound", bars, "inside", "error", "--finite", "--tolerance", "links=0.001"]));
  assert.match(await secondProof(errors), /^Quoted: this page has no proof of this answer/);
  assert.deepEqual(quiet, []);
});

test("Solutions are told at one place and at many", async (browser) => {
  const platform = `${source}/models/rpr_6.toml`;
  const { page, faults } = await open(browser, pageOf("solutions", ["solve", platform]));
  assert.equal(await textOf(page, "#verdict"), "COMPLETE: 6 poses");
  assert.match(await textOf(page, "main"), /these 6 poses are all.*Ask again: ?regulus solve/s);
  await requireAccessible(page, "solutions");
  assert.deepEqual(faults, []);
  const table = `${work}/places.csv`;
  writeFileSync(table, "rho_1,rho_2,rho_3\n14.98,15.38,12\n14,15.38,12\n");
  const { page: many, faults: none } = await open(browser, pageOf("places", ["solve", platform, "--waypoints", table]));
  assert.match(await textOf(many, "#verdict"), /^COMPLETE at 2 of 2 places/);
  assert.match(await textOf(many, "main"), /line 2: COMPLETE: 6 poses.*line 3: COMPLETE/s);
  assert.deepEqual(none, []);
});

/** The points of the robot that are shown, from the page's table of numbers. */
const pointsShown = (page) =>
  page.evaluate(() => {
    document.querySelector("#points").open = true;
    return [...document.querySelectorAll("#points tbody tr")].map((row) => [...row.cells].slice(1).map((cell) => Number(cell.textContent)));
  });

/** Fails unless each solution of the page, when it is picked, has what `check` asks of its points. */
async function eachSolution(page, count, check) {
  assert.equal((await page.$$(".solutions tbody tr")).length, count);
  for (let i = 0; i < count; ++i) {
    await page.evaluate((k) => document.querySelectorAll(".solutions tbody button")[k].click(), i);
    assert.match(await textOf(page, ".sliders output"), new RegExp(`^${i + 1} of ${count}$`));
    check(await pointsShown(page), i);
  }
}

/** Anchors of legs follow those of the base; the legs of all solutions have the lengths that were given. */
function requireLengths(points, lengths, solution) {
  assert.equal(points.length, 2 * lengths.length);
  lengths.forEach((length, leg) => {
    const [a, b] = [points[leg], points[lengths.length + leg]];
    const found = Math.hypot(...a.map((x, axis) => x - b[axis]));
    assert.ok(Math.abs(found - length) < 2e-5 * Math.max(length, 1), `leg ${leg + 1} of solution ${solution + 1}: ${found} and ${length}`);
  });
}

test("A platform in the plane is drawn in all its poses", async (browser) => {
  const { page, faults } = await open(browser, pageOf("poses", ["solve", `${source}/models/rpr_6.toml`]));
  assert.match(await textOf(page, "main"), /The robot in all 6 poses/);
  await eachSolution(page, 6, (points, i) => requireLengths(points, [14.98, 15.38, 12], i));
  const ghosts = () => page.$eval(".ghosts", (path) => path.getAttribute("d").split("M").length - 1);
  assert.equal(await ghosts(), 5 * 6); // of each other pose three legs and three sides of the platform
  await page.click("#others");
  assert.equal(await ghosts(), 0);
  assert.deepEqual(faults, []);
});

test("A platform on six legs is drawn in all its forty poses", async (browser) => {
  const { page, faults } = await open(browser, pageOf("forty", ["solve", `${source}/models/dietmaier.toml`]), { width: 390 });
  assert.match(await textOf(page, "main"), /The robot in all 40 poses/);
  const caption = await page.$eval(".solutions .caption", (words) => words.getBoundingClientRect().right);
  assert.ok(caption <= 390, `the caption ends at ${caption}`);
  await eachSolution(page, 40, (points, i) => requireLengths(points, [1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071], i));
  assert.ok((await page.evaluate(() => document.scrollingElement.scrollWidth)) <= 390);
  await requireAccessible(page, "forty poses");
  assert.deepEqual(faults, []);
});

test("An arm is drawn in all its postures, with its tool where it was asked to be", async (browser) => {
  const { page, faults } = await open(browser, pageOf("postures", ["solve", `${source}/models/manocha_canny.toml`]));
  const unit = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  await eachSolution(page, 16, (points, i) =>
    unit.forEach((axis, k) => axis.forEach((x, j) =>
      assert.ok(Math.abs(points[points.length - 3 + k][j] - x) < 1e-4, `solution ${i + 1}: ${points.slice(-3).join(" | ")}`))));
  assert.match(await textOf(page, ".note"), /^To scale: a square of the floor is .* wide. Grey cylinders are joints/);
  assert.deepEqual(faults, []);
});

test("A list that may be longer says so, and has not all of its boxes", async (browser) => {
  const file = pageOf("open_boxes", ["solve", `${source}/models/puma_560_serial.toml`, "ready", "--at", "T=0.5", "--max-boxes", "10000"]);
  const { page, faults } = await open(browser, file);
  assert.match(await textOf(page, "#verdict"), /^INCOMPLETE: at least/);
  assert.match(await page.$eval("details[open] pre", (text) => text.textContent), /^open .*more boxes/ms);
  assert.match(await textOf(page, "main"), /that (is|are) certain/);
  const data = await page.$eval("#data", (element) => JSON.parse(element.textContent));
  assert.equal(data.report.open_boxes.length, 16);
  assert.deepEqual(faults, []);
});

test("An arm has its base and its tool, and stays in view", async (browser) => {
  const { page, faults } = await open(browser, makePage("arm", [`${source}/models/scara.toml`, "right_handed"]));
  await secondProof(page);
  assert.equal((await page.$$(".robot-drawing polygon")).length, 1);
  for (const steps of [[500, 500, 500, 500], [0, 0, 1000, 0], [1000, 0, 0, 500], [1000, 1000, 1000, 1000]]) {
    const ends = await page.evaluate((values) => {
      values.forEach((value, k) => {
        const slider = document.getElementById(`slider-${k}`);
        slider.value = value;
        slider.dispatchEvent(new Event("input"));
      });
      return [...document.querySelectorAll(".robot-drawing line")].map((line) => ["x1", "y1", "x2", "y2", "stroke"].map((name) => line.getAttribute(name)));
    }, steps);
    assert.equal(new Set(ends.map((line) => line[4]).filter((colour) => ["#cc79a7", "#009e73", "#0072b2"].includes(colour))).size, 3);
    for (const [x1, y1, x2, y2] of ends)
      assert.ok([x1, x2].every((x) => x >= 0 && x <= 800) && [y1, y2].every((y) => y >= 0 && y <= 600), `${steps}: ${[x1, y1, x2, y2]}`);
  }
  assert.deepEqual(faults, []);
});

test("A place of a table is picked, as often as one likes", async (browser) => {
  const table = `${work}/two_places.csv`;
  writeFileSync(table, "rho_1,rho_2,rho_3\n14.98,15.38,12\n14.9,15.3,12.5\n1,1,100\n");
  const { page, faults } = await open(browser, pageOf("picked_places", ["solve", `${source}/models/rpr_6.toml`, "--waypoints", table]));
  const lengths = [[14.98, 15.38, 12], [14.9, 15.3, 12.5]];
  for (let i = 0; i < 20; ++i) { // a browser keeps 16 drawings
    await page.select("#place", String(i % 2));
    await drawn(page);
    if (i < 2) {
      const count = (await page.$$(".solutions tbody tr")).length;
      assert.ok(count >= 2, String(count));
      await eachSolution(page, count, (points, k) => requireLengths(points, lengths[i], k));
    }
  }
  await page.select("#place", "2");
  assert.match(await textOf(page, "main"), /No solution is certain here/);
  assert.deepEqual(faults, []);
});

test("Solutions without points are listed, and the page says why they are not drawn", async (browser) => {
  const { page, faults } = await open(browser, pageOf("configurations", ["solve", `${source}/models/four_bar.toml`, "inside", "--at", "theta=1"]));
  assert.match(await textOf(page, "main"), /All 2 configurations.*equations and no points, so there is no robot to draw/s);
  assert.equal((await page.$$(".solutions tbody tr")).length, 2);
  assert.equal(await page.$(".robot-view"), null);
  assert.deepEqual(faults, []);
});

test("A proof of solutions is in the page that was written with it, and is verified", async (browser) => {
  const proof = `${work}/written.txt`;
  const model = `${source}/models/rpr_6.toml`;
  const file = pageOf("proved_poses", ["solve", model, "--at", "rho_1=14.9", "--certificate", proof]);
  const { page } = await open(browser, file);
  assert.match(await textOf(page, "main"), /regulus verify proof.txt --model rpr_6.toml --allow-options.*Save proof.txt/s);
  const data = await page.$eval("#data", (element) => JSON.parse(element.textContent));
  assert.equal(data.certificate, readFileSync(proof, "utf8"));
  const saved = `${work}/saved.txt`;
  writeFileSync(saved, data.certificate);
  assert.match(execFileSync(regulus, ["verify", saved, "--model", model, "--allow-options"], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }), /VERIFIED/);
});

test("A page names no folder of the computer that made it", async () => {
  const model = `${work}/own_robot.toml`;
  writeFileSync(model, readFileSync(planar, "utf8"));
  const table = `${work}/own_places.csv`;
  writeFileSync(table, "rho_1,rho_2,rho_3\n14.98,15.38,12\n");
  const pages = [
    makePage("own", [model, "regular"]),
    pageOf("own_paving", ["locate", model, "crossing"]),
    pageOf("own_places_page", ["solve", `${source}/models/rpr_6.toml`, "--waypoints", table]),
  ];
  const way = makePage("own_way", [cart([[1, 1], [2, 1.5]])]);
  assert.match(readFileSync(way, "utf8"), /"file":"way.csv"/);
  for (const file of [...pages, way]) {
    const html = readFileSync(file, "utf8");
    for (const folder of [work, source]) assert.ok(!html.includes(folder), `${folder} in ${file}`);
  }
  assert.match(readFileSync(pages[0], "utf8"), /regulus report own_robot.toml regular -o own.html/);
});

test("A button proves the verdict again", async (browser) => {
  const { page } = await open(browser, safe);
  await secondProof(page);
  await page.click("#prove-again");
  assert.equal(await page.$eval("#verdict", (line) => line.className), "unchecked");
  assert.match(await textOf(page, "#again"), /^(Not checked yet|Proving again)/);
  assert.match(await secondProof(page), /^RE-PROVED IN THIS BROWSER: 3 of 3/);
  assert.equal(await page.$eval("#verdict", (line) => line.className), "no-singularity");
});

test("Angles are in degrees, and exact ones exactly", async (browser) => {
  const { page } = await open(browser, safe);
  assert.match(await textOf(page, "#asked"), /psi from -15° to 15°/);
  assert.doesNotMatch(await textOf(page, "main section:first-of-type"), /rad|0\.26/);
});

test("Tolerances and ranges are decimals, where these are exact", async (browser) => {
  const { page } = await open(browser, makePage("decimals", [robot, "table4_1", "--tolerance", "base=0.1", "--tolerance", "platform=1/3000", "--range", "x=0.125:1"]));
  assert.match(await textOf(page, "#asked"), /x from 0\.125 cm to 1 cm.*base ±0\.1 cm.*platform ±1\/3000 cm/s);
});

test("A proof by one box says so, and isolines show how far from singular it is", async (browser) => {
  const model = `${work}/one_box.toml`;
  // det = 4 y: isolines are lines of equal y, and their levels have equal steps.
  writeFileSync(model, readFileSync(cart([[1, 1], [2, 1]]), "utf8").replace(/\[motion[^]*/, '[motion.box]\nx = [1, 3]\ny = [1, 2]\n'));
  const { page, faults } = await open(browser, makePage("one_box", [model]));
  await secondProof(page);
  assert.match(await textOf(page, "main"), /One box is the whole proof/);
  assert.equal(await page.$(".icicle"), null);
  assert.match(await textOf(page, ".legend"), /isolines of .det.: sampled, not proved/);
  const places = await page.$$eval(".main-slice .isoline", (lines) => lines.map((line) => line.getAttribute("d").match(/[\d.]+ [\d.]+/g).map((place) => place.split(" ").map(Number))));
  assert.ok(places.length >= 4, String(places.length));
  const across = await page.$eval("#axis-across", (select) => select.selectedOptions[0].textContent);
  const levels = places.map((line) => {
    const values = line.map(([x, y]) => (across === "y" ? x / 400 : 1 - y / 400));
    assert.ok(values.every((value) => Math.abs(value - values[0]) < 1e-3), values.join());
    return 4 * (1 + values[0]);
  });
  const step = levels[1] - levels[0];
  levels.forEach((level) => assert.ok(Math.abs(level / step - Math.round(level / step)) < 0.02, levels.join()));
  assert.deepEqual(faults, []);
});

test("No slice is empty: what has none says so", async (browser) => {
  const cases = [
    [["check", `${source}/models/puma_560_serial.toml`, "ready"], /the matrix is singular, but for roundings/],
    [["check", `${source}/models/rump.toml`, "point"], /x, one value77617.*The motion is a single pose, so it has no slices/s],
    [["check", `${source}/models/cable_8.toml`, "hall", "--load", "weight"], /FEASIBLE.*The robot/s],
  ];
  for (const [words, text] of cases) {
    const { page, faults } = await open(browser, pageOf("no_slices", words));
      assert.match((await textOf(page, "header")) + (await textOf(page, "#contents")), text);
    assert.equal((await page.$$(".slice, .legend")).length, 0, words.join(" "));
    assert.deepEqual(faults, []);
  }
});

test("Paper takes two sheets", async (browser) => {
  for (const file of [safe, paved, pageOf("on_paper", ["solve", `${source}/models/dietmaier.toml`])]) {
    const { page } = await open(browser, file);
    await secondProof(page);
    const pdf = Buffer.from(await page.pdf({ preferCSSPageSize: true, printBackground: true })).toString("latin1");
    const sheets = pdf.match(/\/Type\s*\/Page[^s]/g).length;
    assert.ok(sheets <= 2, `${sheets} sheets of ${file}`);
  }
  const { page } = await open(browser, safe);
  await secondProof(page);
  await page.emulateMediaType("print");
  await page.setViewport({ width: 711, height: 1040 }); // 188 mm by 275 mm
  await drawn(page);
  const ends = await page.$eval(".slices", (slices) => slices.getBoundingClientRect().bottom);
  assert.ok(ends < 1040, `the slices end ${ends} pixels below the top of the first sheet`);
  assert.equal(await page.$eval("section:has(.slices)", (part) => getComputedStyle(part).breakInside), "avoid-page");
  assert.doesNotMatch(await textOf(page, "main"), /at the end of this page/);
});

test("Without a verdict, the page goes to the pose nearest to a singularity", async (browser) => {
  const file = makePage("undecided", [robot, "wide_15", "--range", "x=-40:40", "--max-boxes", "2"]);
  const { page, faults } = await open(browser, file);
  assert.equal(await textOf(page, "#verdict"), "POSSIBLE PROBLEM");
  assert.match(await textOf(page, "main"), /The pose to look atSampled, not proved/);
  assert.deepEqual(faults, []);
});

test("What is sampled is hatched, and the legend says so", async (browser) => {
  const { page } = await open(browser, paved);
  assert.match(await textOf(page, ".legend"), /sampled, not proved/);
  const fills = await page.$$eval(".main-slice rect.sampled", (marks) => marks.map((mark) => mark.getAttribute("fill")));
  assert.ok(fills.length > 10 && fills.every((fill) => fill.startsWith("url(#hatch")), fills.join());
});

test("The keyboard reaches and moves everything", async (browser) => {
  const { page } = await open(browser, paved);
  await secondProof(page);
  await page.evaluate(() => {
    globalThis.reached = new Set();
    document.addEventListener("focusin", (event) => globalThis.reached.add(event.target));
  });
  const count = await page.$$eval("a, button, input, select, summary, [tabindex='0']", (all) => all.length);
  for (let i = 0; i < count + 20; ++i) await page.keyboard.press("Tab");
  const missed = await page.evaluate(() =>
    [...document.querySelectorAll("a, button, input, select, summary, [tabindex='0']")]
      .filter((element) => !globalThis.reached.has(element) && element.checkVisibility())
      .map((element) => element.outerHTML.slice(0, 100)));
  assert.deepEqual(missed, []);
  await page.$eval(".icicle", (tree) => tree.focus());
  await page.keyboard.press("ArrowDown");
  assert.match(await textOf(page, ".status"), /^Box 1: /);
  await page.keyboard.press("ArrowRight");
  assert.match(await textOf(page, ".status"), /^Box 2: /);
  await page.focus("#slider-0");
  const before = await textOf(page, ".slider output");
  await page.keyboard.press("ArrowLeft");
  assert.notEqual(await textOf(page, ".slider output"), before);
});

test("It is readable in the dark, on a phone, on paper and without scripts", async (browser) => {
  const { page: dark, faults } = await open(browser, safe, { scheme: "dark", width: 390 });
  await secondProof(dark);
  await requireAccessible(dark, "dark");
  const width = await dark.evaluate(() => document.scrollingElement.scrollWidth);
  assert.ok(width <= 390, `${width} pixels wide`);
  assert.equal(await dark.$eval(".leg-legend .scale", (scale) => scale.getClientRects().length), 1);
  await dark.emulateMediaType("print");
  const shown = await dark.evaluate(() => [".robot-view canvas", ".robot-drawing"].map((name) => getComputedStyle(document.querySelector(name)).display));
  assert.deepEqual(shown, ["none", "block"]);
  assert.ok((await dark.$$(".robot-drawing line")).length >= 6);
  assert.deepEqual(faults, []);
  const { page: plain } = await open(browser, safe, { scripts: false });
  const text = await plain.evaluate(() => document.body.innerText).catch(() => null);
  const html = text ?? readFileSync(safe, "utf8").replace(/<script[\s\S]*?<\/script>/g, "");
  assert.match(html, /NO SINGULARITY/);
  assert.match(html, /full rank for every pose of the motion/);
  assert.match(html, /boxes {6}5 evaluated/);
});

/** Changes the data of a page, and says that they are what was written. */
function forged(file, change) {
  const html = readFileSync(file, "utf8");
  return html.replace(/(<script type="application\/json" id="data" data-sha256=")[0-9a-f]{64}(">)([^]*?)(<\/script>)/, (_, a, b, json, c) => {
    const data = JSON.parse(json);
    change(data);
    const text = JSON.stringify(data).replaceAll("<", "\\u003c").replace(/[\u0080-\uffff]/g, (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`);
    return a + createHash("sha256").update(text).digest("hex") + b + text + c;
  });
}

async function lookAt(browser, name, html) {
  const file = `${work}/${name}.html`;
  writeFileSync(file, html);
  const { page } = await open(browser, file);
  const again = await secondProof(page);
  return { again, verdict: await textOf(page, "#verdict"), claim: await textOf(page, "#claim") };
}

test("A damaged page claims nothing", async (browser) => {
  const html = readFileSync(safe, "utf8");
  const cases = {
    digit: [html.replace("l 2 mean-value", "l 2 mean-valve"), /SHA-256/],
    words: [html.replace('">NO SINGULARITY</h1>', '">SINGULARITY</h1>'), /verdict in words/],
    claim: [html.replace(/(<p id="claim">)[^<]*/, "$1the robot is perfect"), /verdict in words/],
    model: [forged(safe, (data) => (data.model.text = data.model.text.replace("12, -3", "12, -4"))), /model text/],
    leaf: [forged(safe, (data) => (data.certificate = data.certificate.replace("l 3 h-matrix\n", "").replace("end 3", "end 2"))), /1 boxes of the tree have no leaf/],
    question: [forged(safe, (data) => (data.certificate = data.certificate.replace("x in -15 : 15", "x in -1 : 1"))), /another question/],
    verdict: [forged(safe, (data) => (data.report.verdict = "singularity")), /verdict/],
    number: [forged(pageOf("fewer", ["solve", `${source}/models/rpr_6.toml`]), (data) => data.report.solutions.pop()), /another number of solutions/],
  };
  for (const [name, [damaged, reason]] of Object.entries(cases)) {
    assert.notEqual(damaged, html, name);
    const { verdict, claim, again } = await lookAt(browser, `damaged_${name}`, damaged);
    assert.equal(verdict, "THIS PAGE IS DAMAGED", name);
    assert.match(claim, reason, name);
    assert.equal(again, "", name);
  }
});

test("A page whose program was damaged says that nothing has been checked", async (browser) => {
  const html = readFileSync(safe, "utf8");
  const damaged = html.replace(/(<script>)/, "$1;");
  assert.notEqual(damaged, html);
  const file = `${work}/damaged_program.html`;
  writeFileSync(file, damaged);
  const { page } = await open(browser, file);
  assert.match(await textOf(page, "#again"), /^Not checked yet/);
  assert.equal(await page.$eval("#verdict", (line) => line.className), "unchecked");
});

test("A false claim is not proved again", async (browser) => {
  // The planar robot is singular in this wider range.
  const worse = (text) => text.replace(/^(parameter phi in .* : ).*$/m, "$11");
  const html = forged(makePage("regular", [planar, "regular"]), (data) => {
    data.question = worse(data.question);
    data.certificate = worse(data.certificate);
  });
  const { again } = await lookAt(browser, "false", html);
  assert.match(again, /^NOT RE-PROVED: the simpler test/);
});

test("A model cannot put scripts into its page", async (browser) => {
  const name = `</script><script>alert(1)</script><img src=x onerror=alert(2)> é @REGULUS_DATA@`;
  const model = `${work}/hostile.toml`;
  writeFileSync(model, readFileSync(planar, "utf8").replace('name = "planar 3-RPR"', `name = ${JSON.stringify(name)} # </script><!-- \u2028`));
  const { page, faults } = await open(browser, makePage("hostile", [model, "regular"]));
  assert.match(await secondProof(page), /^RE-PROVED/);
  assert.match(await page.title(), /<\/script><script>alert\(1\)/);
  assert.deepEqual(faults, []);
});

test("5000 boxes fit into 1.5 MB", async (browser) => {
  const file = makePage("large", [planar, "crossing", "--paving", "--resolution", "1/48"]);
  const { page, faults } = await open(browser, file);
  await secondProof(page);
  const boxes = Number(/(\d+) boxes/.exec(await textOf(page, "main"))?.[1]);
  assert.ok(boxes >= 5000, `${boxes} boxes`);
  assert.ok(statSync(file).size <= 1.5e6, `${statSync(file).size} bytes`);
  assert.deepEqual(faults, []);
});

const [part, parts] = process.argv.slice(2).map(Number);
await inBrowser(async (browser) => {
  let failed = 0;
  for (const { name, run } of tests.filter((_, i) => i % parts === part)) {
    const start = performance.now();
    try {
      await run(browser);
      console.log(`ok      ${name} (${((performance.now() - start) / 1000).toFixed(1)} s)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n${error.message}`);
    }
  }
  process.exitCode = failed > 0 ? 1 : 0;
});
