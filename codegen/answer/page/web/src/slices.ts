// SPDX-License-Identifier: GPL-3.0-or-later
// Slices through the boxes. What is certified is solid; what is only sampled is hatched and says so.
import { PageData } from "./data";
import { h, section, svg, table } from "./dom";
import { ShownPose } from "./pose";
import { Question } from "./question";
import { Grid, isolines, levelsOf, Samples } from "./samples";
import { leavesAt, Tree, TreeBox } from "./tree";
import { describeRange, describeValue, shortNumber } from "./units";

export type Claim = "free" | "singular" | "undecided" | "outside" | "unreachable";

export const CLAIM_WORDS: Record<Claim, string> = {
  free: "certified: no singularity",
  singular: "certified: holds a singularity",
  undecided: "neither was shown",
  outside: "certified: outside the constraints",
  unreachable: "certified: out of reach",
};

/** The claim of a leaf: of a paving its word; of a proof every leaf is free or outside. */
export function claimOfWord(word: string, isPaving: boolean): Claim {
  if (!isPaving) return word === "outside" ? "outside" : "free";
  return word in CLAIM_WORDS ? (word as Claim) : "undecided";
}

/** The proved parts of the motion with each claim of a paving; null without one. */
export function sharesPart({ paving }: PageData): HTMLElement | null {
  if (!paving) return null;
  // Two digits, rounded to the side that claims less.
  const percent = (x: number, round: (y: number) => number): string => `${shortNumber(round(1e4 * x) / 100)} %`;
  const rows = (Object.keys(CLAIM_WORDS) as Claim[]).flatMap((claim) => {
    const share = paving.summary[claim];
    if (!share || !(share.boxes > 0)) return [];
    const [lo, hi] = share.fraction;
    return [[h("span", { class: `key ${claim}` }), CLAIM_WORDS[claim], String(share.boxes), percent(lo, Math.floor), percent(hi, Math.ceil)]];
  });
  return rows.length > 0 ? section("Parts of the motion", table(["colour", "claim", "boxes", "at least", "at most"], rows, "Parts of the ranges, by volume")) : null;
}

const SIZE = 400;
const GRID = 40; // cells of the large slice in each direction
const SMALL_GRID = 24;

let patterns = 0;

function hatch(id: string, className: string): SVGElement {
  return svg(
    "pattern",
    { id, width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
    svg("rect", { width: 3, height: 7, class: className }),
  );
}

interface Axes {
  across: number;
  up: number;
  stack: number; // -1: none
}

export class Slices {
  readonly element: HTMLElement;
  private readonly axes: Axes;
  private readonly free: number[]; // parameters that are not single values
  private readonly samples: Samples | null;
  private readonly isZero: boolean; // the samples are, and not shown
  private readonly figures = h("div", { class: "slices" });
  private showSamples = true;
  private isWaiting = false;

  constructor(
    private readonly data: PageData,
    private readonly question: Question,
    private readonly pose: ShownPose,
    private readonly tree: Tree | null,
    private readonly isPaving: boolean,
  ) {
    this.free = question.parameters.flatMap(({ range }, k) => (range.lo < range.hi ? [k] : []));
    const samples = question.matrix.length > 0 && this.free.length > 0 ? new Samples(question) : null;
    this.isZero = samples?.isZero ?? false;
    this.samples = this.isZero ? null : samples;
    const telling = this.tellingParameters();
    this.axes = { across: telling[0] ?? -1, up: telling[1] ?? -1, stack: telling[2] ?? -1 };
    const title = "Slices through the motion";
    if (this.free.length === 0 || (!tree && !this.samples)) {
      const words = this.free.length === 0 ? "The motion is a single pose, so it has no slices." : this.introduction();
      this.element = section(title, h("p", {}, words));
      return;
    }
    this.element = section(
      title,
      h("p", {}, this.introduction()),
      this.choices(),
      this.legend(),
      this.figures,
    );
    pose.listen(() => this.drawSoon());
    this.draw();
  }

  /** The parameters along which a slice shows something come first. */
  private tellingParameters(): number[] {
    const changing = this.samples?.changing() ?? new Set<number>();
    let next = 0;
    const numbers = this.question.variables.map(({ kind }) => (kind === "parameter" ? next++ : -1));
    const visit = (node: TreeBox): void => {
      if (node.halves.length > 0) changing.add(numbers[node.variable]);
      node.halves.forEach(visit);
    };
    if (this.tree) visit(this.tree.root);
    const telling = this.free.filter((k) => changing.has(k));
    // One slice for each value of a parameter without effect would be five times the same.
    return telling.length >= 2 ? telling : [...telling, ...this.free.filter((k) => !changing.has(k))].slice(0, 2);
  }

  private introduction(): string {
    return `${this.whatIsShown()} ${this.howFar()}`;
  }

  private whatIsShown(): string {
    if (this.isPaving)
      return "Each slice shows the boxes of the paving that meet a plane; the other parameters have the values of the sliders.";
    if (!this.tree) return "This page has no proof over boxes to show here; that of regulus report with --paving has boxes.";
    if (this.tree.leaves.length === 1) return `One box is the whole proof (by the rule ${this.tree.leaves[0].word}), so every slice has one colour.`;
    return "Each slice shows the boxes of the proof that meet a plane; the other parameters have the values of the sliders.";
  }

  private howFar(): string {
    const { samples } = this;
    if (this.isZero) return "At every sample of the motion the matrix is singular, but for roundings; samples prove nothing.";
    if (!samples) return "";
    if (this.free.length === 1) return `The dashed curve is ${samples.isSigned ? "det" : samples.name} at samples; it proves nothing.`;
    const least = shortNumber(Number(((100 * samples.least) / samples.largest).toPrecision(2)));
    return `Isolines show how far the matrix is from singular: ${samples.name} in % of the largest at ${samples.count} samples of the motion, of which the least has ${least} %. They prove nothing.`;
  }

  private choices(): HTMLElement {
    const { parameters } = this.question;
    const choice = (label: string, key: keyof Axes, none: boolean): HTMLElement => {
      const id = `axis-${key}`;
      const select = h(
        "select",
        { id, change: () => ((this.axes[key] = Number(select.value)), this.draw()) },
        ...(none ? [h("option", { value: -1 }, "none")] : []),
        ...this.free.map((k) => h("option", { value: k, selected: k === this.axes[key] }, parameters[k].name)),
      );
      return h("span", {}, h("label", { for: id }, label), " ", select);
    };
    const box = h("input", { type: "checkbox", id: "samples", checked: true, change: () => ((this.showSamples = box.checked), this.draw()) });
    return h(
      "div",
      { class: "choices" },
      choice("across", "across", false),
      choice("up", "up", true),
      choice("one slice for each of", "stack", true),
      this.samples ? h("span", {}, box, " ", h("label", { for: "samples" }, `samples of ${this.samples.name}`)) : null,
    );
  }

  private legend(): HTMLElement {
    const claims = new Set<Claim>(this.tree?.leaves.map((leaf) => claimOfWord(leaf.word, this.isPaving)) ?? []);
    const key = (name: string, text: string): HTMLElement =>
      h("li", {}, h("span", { class: `key ${name}` }), text);
    return h(
      "ul",
      { class: "legend" },
      ...[...claims].map((claim) => key(claim, CLAIM_WORDS[claim])),
      ...this.sampledKeys().map(([name, text]) => key(name, text)),
      key("cross", "the pose that is shown"),
    );
  }

  private sampledKeys(): [string, string][] {
    if (!this.samples) return [];
    const { isSigned, name } = this.samples;
    if (this.free.length === 1) return [["dashed", `${isSigned ? "det" : name} as sampled, not proved; the line is 0`]];
    const lines: [string, string] = ["dashed", `isolines of ${name}: sampled, not proved`];
    return isSigned ? [lines, ["sampled", "sampled, not proved: det changes its sign between neighbouring samples"]] : [lines];
  }

  /** Draws once for all changes before the next frame. */
  private drawSoon(): void {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.draw();
    });
  }

  private draw(): void {
    const { stack } = this.axes;
    const places: (number | null)[] = [null];
    if (stack >= 0 && stack !== this.axes.across && stack !== this.axes.up) {
      const { lo, hi } = this.question.parameters[stack].range;
      for (let i = 0; i < 5; ++i) places.push(lo + ((hi - lo) * (i + 0.5)) / 5);
    }
    const grids = places.map((at) => this.gridAt(at));
    const levels = levelsOf(grids.flatMap((grid) => (grid ? [grid.map((column) => column.map(Math.abs))] : [])));
    const [main, ...others] = places.map((at, i) => this.slice(at, grids[i], levels));
    this.figures.replaceChildren(main, h("div", { class: "stack" }, ...others));
  }

  private valuesAt(at: number | null): number[] {
    const values = [...this.pose.values];
    if (at !== null) values[this.axes.stack] = at;
    return values;
  }

  /** The samples of a slice; null if none are shown, or it has no height. */
  private gridAt(at: number | null): Grid | null {
    const { across, up } = this.axes;
    if (!this.samples || !this.showSamples || up < 0 || up === across) return null;
    const ranges = [across, up].map((k) => this.question.parameters[k].range);
    const point = this.valuesAt(at);
    const cells = at === null ? GRID : SMALL_GRID;
    return Array.from({ length: cells + 1 }, (_, i) =>
      Array.from({ length: cells + 1 }, (__, j) => {
        [point[across], point[up]] = [i, j].map((n, axis) => ranges[axis].lo + ((ranges[axis].hi - ranges[axis].lo) * n) / cells);
        return this.samples!.at(point);
      }));
  }

  /** Isolines, with their numbers where there is room. */
  private isolines(grid: Grid, levels: readonly number[], isMain: boolean): SVGElement[] {
    const { largest } = this.samples!;
    const absolute = grid.map((column) => column.map(Math.abs));
    const cell = SIZE / (grid.length - 1);
    const [x, y] = [(a: number): string => (a * cell).toFixed(1), (b: number): string => (SIZE - b * cell).toFixed(1)];
    return levels.flatMap((level, n) => {
      const lines = isolines(absolute, level);
      if (lines.length === 0) return [];
      const path = svg("path", { d: lines.map((line) => `M${line.map(([a, b]) => `${x(a)} ${y(b)}`).join("L")}`).join(""), class: "isoline" });
      // Not at the border, and not all in one row.
      const inside = lines.flat().filter((place) => place.every((a) => a > 3 && a < GRID - 3));
      if (!isMain || inside.length === 0) return [path];
      const [a, b] = inside[Math.floor(inside.length * ((n * 0.38) % 1))];
      const text = `${shortNumber(Number(((100 * level) / largest).toPrecision(2)))} %`;
      return [path, svg("text", { x: x(a), y: String(Number(y(b)) + 4), class: "isoline-label", "text-anchor": "middle" }, text)];
    });
  }

  /** A slice at the shown pose, or at another value of the parameter `stack`. */
  private slice(at: number | null, grid: Grid | null, levels: readonly number[]): HTMLElement {
    const { across, up, stack } = this.axes;
    const { parameters } = this.question;
    const isMain = at === null;
    const values = this.valuesAt(at);
    const id = `hatch-${++patterns}`;
    const x = parameters[across].range;
    const y = up >= 0 && up !== across ? parameters[up].range : { lo: 0, hi: 1 };
    const hasUp = up >= 0 && up !== across;
    const toX = (value: number): number => ((value - x.lo) / (x.hi - x.lo)) * SIZE;
    const toY = (value: number): number => SIZE - ((value - y.lo) / (y.hi - y.lo)) * SIZE;
    const rectangle = (a: number, b: number, c: number, d: number, name: string): SVGElement =>
      svg("rect", { x: toX(a).toFixed(2), y: toY(d).toFixed(2), width: (toX(b) - toX(a)).toFixed(2), height: (toY(c) - toY(d)).toFixed(2), class: name });
    const shapes: SVGElement[] = [];
    for (const leaf of this.leavesOf(values, hasUp)) {
      const name = claimOfWord(leaf.word, this.isPaving);
      const [p, q] = [leaf.box[across], hasUp ? leaf.box[up] : y];
      shapes.push(rectangle(p.lo, p.hi, q.lo, q.hi, `box ${name}`));
    }
    if (!this.tree) shapes.push(rectangle(x.lo, x.hi, y.lo, y.hi, "box unclaimed"));
    if (grid) {
      shapes.push(...this.isolines(grid, levels, isMain));
      const cell = SIZE / (grid.length - 1);
      shapes.push(...this.signChanges(grid).map(([i, j]) =>
        svg("rect", { x: i * cell, y: SIZE - (j + 1) * cell, width: cell, height: cell, class: "sampled", fill: `url(#${id})` })));
    }
    if (this.showSamples && !hasUp && this.samples) shapes.push(...this.determinantCurve(values));
    const cx = toX(values[across]);
    const cy = hasUp ? toY(values[up]) : SIZE / 2;
    if (isMain) shapes.push(svg("path", { d: `M${cx - 9} ${cy}H${cx + 9}M${cx} ${cy - 9}V${cy + 9}`, class: "cross" }));
    const names = hasUp ? `${parameters[across].name} and ${parameters[up].name}` : parameters[across].name;
    const picture = svg(
      "svg",
      { viewBox: `-2 -2 ${SIZE + 4} ${SIZE + 4}`, role: "img", "aria-label": `Slice over ${names}${at === null ? "" : ` at ${parameters[stack].name} ${shortNumber(at)}`}`, preserveAspectRatio: "none" },
      svg("defs", {}, hatch(id, "sample-line")),
      ...shapes,
    );
    picture.addEventListener("click", (event) => {
      const place = picture.getBoundingClientRect();
      const changes = new Map([[across, x.lo + ((event.clientX - place.left) / place.width) * (x.hi - x.lo)]]);
      if (hasUp) changes.set(up, y.hi - ((event.clientY - place.top) / place.height) * (y.hi - y.lo));
      if (at !== null) changes.set(stack, at);
      this.pose.set(changes);
    });
    return this.framed(picture, isMain, hasUp, at);
  }

  /** det along the only axis, in doubles; the line in the middle is 0. */
  private determinantCurve(values: readonly number[]): SVGElement[] {
    const { across } = this.axes;
    const { lo, hi } = this.question.parameters[across].range;
    const samples = Array.from({ length: 241 }, (_, i) => {
      const point = [...values];
      point[across] = lo + ((hi - lo) * i) / 240;
      return this.samples!.at(point);
    });
    const largest = Math.max(...samples.filter(Number.isFinite).map(Math.abs), 1e-300);
    const places = samples.flatMap((det, i) =>
      Number.isFinite(det) ? [`${((i / 240) * SIZE).toFixed(1)} ${((0.5 - (0.45 * det) / largest) * SIZE).toFixed(1)}`] : []);
    return [
      svg("path", { d: `M0 ${SIZE / 2}H${SIZE}`, class: "zero-line" }),
      svg("path", { d: places.length > 0 ? `M${places.join("L")}` : "M0 0", class: "sample-curve" }),
    ];
  }

  private framed(picture: SVGElement, isMain: boolean, hasUp: boolean, at: number | null): HTMLElement {
    const { parameters } = this.question;
    const axis = (k: number): string => {
      const { name, range } = parameters[k];
      return `${name} from ${describeRange(range.lo, range.hi, this.data.units[name])}`;
    };
    const { across, up, stack } = this.axes;
    const caption =
      at !== null
        ? `${parameters[stack].name} = ${describeValue(at, this.data.units[parameters[stack].name])}`
        : `across: ${axis(across)}${hasUp ? `; up: ${axis(up)}` : ""}`;
    return h("figure", { class: `slice${isMain ? " main-slice" : ""}${hasUp ? "" : " strip"}` }, picture, h("figcaption", {}, caption));
  }

  private leavesOf(values: readonly number[], hasUp: boolean) {
    if (!this.tree) return [];
    let next = 0;
    const { across, up } = this.axes;
    const fixed = this.question.variables.map((variable) => {
      if (variable.kind !== "parameter") return (variable.range.lo + variable.range.hi) / 2;
      const k = next++;
      return k === across || (hasUp && k === up) ? null : values[k];
    });
    return leavesAt(this.tree, fixed);
  }

  /** Cells of a grid at whose corners det has both signs, in doubles. */
  private signChanges(grid: Grid): [number, number][] {
    const cells: [number, number][] = [];
    for (let i = 0; i + 1 < grid.length; ++i)
      for (let j = 0; j + 1 < grid.length; ++j) {
        const corners = [grid[i][j], grid[i + 1][j], grid[i][j + 1], grid[i + 1][j + 1]].map(Math.sign);
        if (corners.includes(1) && corners.includes(-1)) cells.push([i, j]);
      }
    return cells;
  }
}
