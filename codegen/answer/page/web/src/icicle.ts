// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a proof: a row for each level, the width is the part of the volume, the colour the rule.
import { h, section, svg, table } from "./dom";
import { ShownPose } from "./pose";
import { Question } from "./question";
import { Tree, TreeBox } from "./tree";
import { describeRange, describeValue } from "./units";

const WIDTH = 1000;
const RULES = ["h-matrix", "mean-value", "second-order", "orthants", "determinant", "elimination", "rohn", "closed-form", "multiprecision", "filter", "outside"];

/** The class of a rule or a claim in the style sheet. */
const classOf = (word: string): string => (RULES.includes(word) ? `rule-${RULES.indexOf(word)}` : word);

export class Icicle {
  readonly element: HTMLElement;
  private readonly shapes = new Map<TreeBox, SVGElement>();
  private readonly status = h("p", { class: "status", "aria-live": "polite" });
  private chosen: TreeBox;

  constructor(
    private readonly question: Question,
    private readonly tree: Tree,
    private readonly pose: ShownPose,
    what: string,
    private readonly units: Record<string, string>,
  ) {
    this.chosen = tree.root;
    const levels = tree.leaves.reduce((most, leaf) => Math.max(most, leaf.depth), 0) + 1;
    const height = Math.max(14, Math.min(36, 420 / levels));
    const drawing = svg("svg", {
      viewBox: `0 0 ${WIDTH} ${levels * height}`,
      class: "icicle",
      preserveAspectRatio: "none",
      tabindex: 0,
      role: "application",
      "aria-roledescription": "tree of boxes",
      "aria-label": `${what}; arrow keys move between boxes, Enter shows the middle of a box`,
    });
    this.draw(drawing, tree.root, 0, WIDTH, height);
    drawing.addEventListener("keydown", (event) => this.move(event));
    this.choose(tree.root);
    this.element = section(what, h("p", {}, `${tree.leaves.length} boxes cover the whole motion. Each row is a level of splits, each width the part of the volume.`), drawing, this.status, this.rules());
  }

  private draw(drawing: SVGElement, box: TreeBox, x: number, width: number, height: number): void {
    const shape = svg("rect", {
      x: x.toFixed(3),
      y: box.depth * height,
      width: Math.max(width, 0.2).toFixed(3),
      height: height - 1,
      class: box.halves.length > 0 ? "split" : classOf(box.word),
    });
    shape.addEventListener("click", () => this.choose(box));
    this.shapes.set(box, shape);
    drawing.append(shape);
    if (box.halves.length === 0) return;
    const { lo, hi } = box.box[box.variable];
    const lower = hi > lo ? (box.at - lo) / (hi - lo) : 0.5;
    this.draw(drawing, box.halves[0], x, width * lower, height);
    this.draw(drawing, box.halves[1], x + width * lower, width * (1 - lower), height);
  }

  private choose(box: TreeBox): void {
    this.shapes.get(this.chosen)?.classList.remove("chosen");
    this.chosen = box;
    this.shapes.get(box)?.classList.add("chosen");
    const { variables } = this.question;
    const ranges = box.box.flatMap(({ lo, hi }, k) =>
      variables[k].kind === "parameter" ? [`${variables[k].name} ${describeRange(lo, hi, this.units[variables[k].name])}`] : []);
    const state = box.halves.length > 0 ? `split at ${variables[box.variable].name} = ${describeValue(box.at, this.units[variables[box.variable].name])}` : box.word;
    this.status.textContent = `Box ${box.id}: ${state}; ${ranges.join(", ")}`;
  }

  private move(event: KeyboardEvent): void {
    const { parent, halves } = this.chosen;
    const [lower, upper] = parent?.halves ?? [];
    const next: Record<string, TreeBox | null | undefined> = {
      ArrowUp: parent,
      ArrowDown: halves[0],
      ArrowLeft: this.chosen === upper ? lower : null,
      ArrowRight: this.chosen === lower ? upper : null,
    };
    if (event.key === "Enter") this.showMiddle();
    else if (!(event.key in next)) return;
    event.preventDefault();
    const target = next[event.key];
    if (target) this.choose(target);
  }

  private showMiddle(): void {
    let next = 0;
    const changes = new Map<number, number>();
    this.question.variables.forEach(({ kind }, k) => {
      const { lo, hi } = this.chosen.box[k];
      if (kind === "parameter") changes.set(next++, (lo + hi) / 2);
    });
    this.pose.set(changes);
  }

  private rules(): HTMLElement {
    const counts = new Map<string, number>();
    for (const { word } of this.tree.leaves) counts.set(word, (counts.get(word) ?? 0) + 1);
    return table(
      ["colour", "leaf", "boxes"],
      [...counts].map(([word, count]) => [h("span", { class: `key ${classOf(word)}` }), word, String(count)]),
      "Leaves of the tree",
    );
  }
}
