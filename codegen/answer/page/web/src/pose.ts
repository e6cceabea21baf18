// SPDX-License-Identifier: GPL-3.0-or-later
// The pose that every part of the page shows, with a slider for each motion parameter.
import { Bounds, PageData, ReportedPoint } from "./data";
import { h } from "./dom";
import { Question } from "./question";
import { Vector } from "./robot";
import { describeValue } from "./units";

export const middleOf = ([lo, hi]: Bounds): number => ((lo ?? NaN) + (hi ?? NaN)) / 2;

/** The pose of a page, whatever the parameters of the motion are. */
export interface Shown {
  readonly values: ArrayLike<number>;
  /** Shows a pose of the report. */
  goTo(point: ReportedPoint): void;
  /** Returns the platform's centre. */
  origin(): Vector;
}

/** The pose parameters x, y and z at values of the motion parameters. */
export function originAt(question: Question, values: ArrayLike<number>): Vector {
  const found = question.approximateAt(values);
  return ["x", "y", "z"].map((name) => {
    const id = question.commanded.get(name);
    return id === undefined ? 0 : found[id];
  }) as unknown as Vector;
}

export class ShownPose implements Shown {
  readonly values: number[];
  private readonly listeners: (() => void)[] = [];

  constructor(readonly question: Question) {
    this.values = question.parameters.map(({ range }) => (range.lo + range.hi) / 2);
  }

  listen(listener: () => void): void {
    this.listeners.push(listener);
  }

  set(changes: ReadonlyMap<number, number>): void {
    for (const [k, value] of changes) {
      const { lo, hi } = this.question.parameters[k].range;
      this.values[k] = Math.min(Math.max(value, lo), hi);
    }
    for (const listener of this.listeners) listener();
  }

  goTo(point: ReportedPoint): void {
    const changes = new Map<number, number>();
    this.question.parameters.forEach(({ name }, k) => {
      if (point.parameters[name]) changes.set(k, middleOf(point.parameters[name]));
    });
    this.set(changes);
  }

  origin(): Vector {
    return originAt(this.question, this.values);
  }
}

const STEPS = 1000;

/** The sliders; those of single values are not shown. */
export function poseSliders(pose: ShownPose, data: PageData): HTMLElement {
  const rows = pose.question.parameters.map(({ name, range }, k) => {
    const unit = data.units[name];
    const width = range.hi - range.lo;
    const output = h("output", {});
    if (width === 0) {
      output.textContent = describeValue(range.lo, unit, 6);
      return h("div", { class: "slider" }, h("span", {}, `${name}, one value`), output);
    }
    const id = `slider-${k}`;
    const input = h("input", {
      type: "range",
      id,
      min: 0,
      max: STEPS,
      step: 1,
      "data-parameter": name,
      input: () => pose.set(new Map([[k, range.lo + (width * Number(input.value)) / STEPS]])),
    });
    const show = (): void => {
      input.value = String(Math.round(((pose.values[k] - range.lo) / width) * STEPS));
      const text = describeValue(pose.values[k], unit);
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
    };
    pose.listen(show);
    show();
    return h("div", { class: "slider" }, h("label", { for: id }, name), input, output);
  });
  return h("div", { class: "sliders" }, ...rows);
}
