// SPDX-License-Identifier: GPL-3.0-or-later
// A motion along way-points: its pieces, and the place on it that the page shows. A place is u: the
// number of the piece, from 0, and the part of it that lies behind.
import { DrawingData, DrawnPart, PageData, ReportedPoint, WayData } from "./data";
import { h } from "./dom";
import { Damage } from "./expression";
import { middleOf, originAt, Shown } from "./pose";
import { Question } from "./question";
import { Drawable, Robot, Vector } from "./robot";
import { describeValue, roundedTo, shortNumber, withUnit } from "./units";

const STEPS = 100; // of a slider, in each piece
const MOST_PLACES = 64;

export class Way implements Shown {
  readonly values = [0]; // u
  readonly about: WayData;
  readonly count: number;
  private readonly questions = new Map<number, Question>();
  private readonly listeners: (() => void)[] = [];

  constructor(readonly data: PageData) {
    this.about = data.way!;
    this.count = this.about.pieces.length;
    if (this.question(0).pieces !== this.count) throw new Damage("the way-points are not those of the question");
  }

  question(piece: number): Question {
    let found = this.questions.get(piece);
    if (!found) this.questions.set(piece, (found = new Question(this.data.question, piece)));
    return found;
  }

  /** The piece of a place, and the parameter on it. */
  split(u: number): { piece: number; s: number } {
    const piece = Math.min(Math.max(Math.floor(u), 0), this.count - 1);
    return { piece, s: Math.min(Math.max(u - piece, 0), 1) };
  }

  time(u: number): number {
    const { piece, s } = this.split(u);
    const [begin, end] = this.about.pieces[piece].times;
    return begin + s * (end - begin);
  }

  /** "segment 3, t = 1.5 s" */
  describe(u: number): string {
    const segment = `segment ${this.split(u).piece + 1}`;
    const { time_unit } = this.about;
    return time_unit === null ? segment : `${segment}, t = ${withUnit(shortNumber(Number(this.time(u).toPrecision(4))), time_unit)}`;
  }

  /** "from 0.17 to 0.18 s": a part of a piece, not narrower than it is. */
  describePart(piece: number, begin: number, end: number): string {
    const { time_unit } = this.about;
    const [lo, hi] = [begin, end].map((s) => (time_unit === null ? s : this.about.pieces[piece].times[0] + s * (this.about.pieces[piece].times[1] - this.about.pieces[piece].times[0])));
    const ends = `from ${roundedTo(lo, Math.floor)} to ${roundedTo(hi, Math.ceil)}`;
    return time_unit === null ? `${ends} of its length` : withUnit(ends, time_unit);
  }

  listen(listener: () => void): void {
    this.listeners.push(listener);
  }

  set(u: number): void {
    this.values[0] = Math.min(Math.max(u, 0), this.count);
    for (const listener of this.listeners) listener();
  }

  goTo(point: ReportedPoint): void {
    const { segment } = this.data.report;
    if (segment) this.set(segment.segment - 1 + middleOf(segment.s ?? Object.values(point.parameters)[0] ?? [0.5, 0.5]));
  }

  origin(): Vector {
    const { piece, s } = this.split(this.values[0]);
    return originAt(this.question(piece), [s]);
  }

  /** Values of the pose parameters, in doubles. */
  pose(u: number): { name: string; value: number }[] {
    const { piece, s } = this.split(u);
    const question = this.question(piece);
    const values = question.approximateAt([s]);
    return question.pose.map(({ name, commanded }) => ({ name, value: values[commanded] }));
  }
}

/** The robot at places of a way. */
export class WayRobot implements Drawable {
  readonly parts: readonly DrawnPart[];
  private readonly robots = new Map<number, Robot>();

  constructor(
    private readonly drawing: DrawingData,
    private readonly way: Way,
  ) {
    this.parts = drawing.parts;
  }

  at(values: ArrayLike<number>): Vector[] {
    const { piece, s } = this.way.split(values[0]);
    let robot = this.robots.get(piece);
    if (!robot) this.robots.set(piece, (robot = new Robot(this.drawing, this.way.question(piece))));
    return robot.at([s]);
  }

  places(): number[][] {
    const { count } = this.way;
    const many = Math.min(2 * count, MOST_PLACES);
    return Array.from({ length: many + 1 }, (_, i) => [(count * i) / many]);
  }
}

/** A slider along the way, and the pose there. */
export function waySlider(way: Way, units: Record<string, string>): HTMLElement {
  const output = h("output", {});
  const input = h("input", {
    type: "range",
    id: "slider-0",
    min: 0,
    max: STEPS * way.count,
    step: 1,
    input: () => way.set(Number(input.value) / STEPS),
  });
  const pose = h("p", { class: "status pose" });
  const show = (): void => {
    const [u] = way.values;
    input.value = String(Math.round(u * STEPS));
    output.textContent = way.describe(u);
    input.setAttribute("aria-valuetext", way.describe(u));
    pose.textContent = way.pose(u).map(({ name, value }) => `${name} = ${describeValue(value, units[name])}`).join(", ");
  };
  way.listen(show);
  show();
  return h("div", { class: "sliders" }, h("label", { for: "slider-0" }, "along the way"), input, h("p", {}, output), pose);
}
