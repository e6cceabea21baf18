// SPDX-License-Identifier: GPL-3.0-or-later
// The solutions at a place: the robot in all of them, one bold and the others faint, and their table.
import { PageData, Solution, SolvedPlace } from "./data";
import { Child, h, section, table } from "./dom";
import { middleOf } from "./pose";
import { SolvedRobot, Vector } from "./robot";
import { Changing, floorNote, legColours, pointsTable } from "./robot_part";
import { RobotView } from "./robot_view";
import { describeValue, withUnit } from "./units";

/** The places of an answer; the only one has no title. */
interface Place {
  readonly title: string;
  readonly given: Record<string, number>;
  readonly solutions: readonly Solution[];
}

const MOST_DRAWN = 500; // of many places
const SIGNS = { positive: "+", negative: "−", unknown: "?" };
const LIMITS = { none: "", within: "within", beyond: "beyond", border: "at the border" };

function placesOf(data: PageData): Place[] {
  const values = (place: SolvedPlace["place"] | undefined): Record<string, number> =>
    Object.fromEntries(Object.entries(place ?? {}).map(([name, { enclosure }]) => [name, middleOf(enclosure)]));
  const { solutions, places, question } = data.report;
  if (!places) return [{ title: "", given: values(question?.place), solutions: solutions ?? [] }];
  const given = (place: SolvedPlace["place"]): string =>
    Object.entries(place).map(([name, { enclosure, unit }]) => `${name} = ${describeValue(middleOf(enclosure), unit)}`).join(", ");
  return places.slice(0, MOST_DRAWN).map(({ line, place, solutions: found }) =>
    ({ title: `${data.report.places_file ? "line" : "place"} ${line}: ${given(place)}`, given: values(place), solutions: found }));
}

/** "poses", as the headline of one place or of many has it. */
function nounOf(data: PageData, count: number): string {
  const word = /([a-z]+)$/.exec(data.headline)?.[1] ?? "solutions";
  return count === 1 ? word.replace(/s$/, "") : /s$/.test(word) ? word : `${word}s`;
}

/** Chooses a solution by a slider and by the rows of the table. */
class Chooser implements Changing {
  readonly element: HTMLElement;
  private readonly listeners: (() => void)[] = [];
  private chosen = 0;
  private showsOthers = true;
  private readonly points: Vector[][];
  private readonly input: HTMLInputElement;
  private readonly output = h("output", {});
  private readonly rows: HTMLButtonElement[];

  constructor(
    private readonly data: PageData,
    private readonly place: Place,
    private readonly robot: SolvedRobot | null,
    private readonly view: RobotView | null,
    colours: Child,
  ) {
    const { solutions } = place;
    const one = nounOf(data, 1);
    this.points = robot ? robot.places().map((values) => robot.at(values)) : [];
    this.input = h("input", { type: "range", id: "solution", min: 1, max: solutions.length, step: 1, value: 1, input: () => this.choose(Number(this.input.value) - 1) });
    this.rows = solutions.map((_, i) => h("button", { type: "button", class: "row", "aria-label": `Show ${one} ${i + 1}`, click: () => this.choose(i) }, String(i + 1)));
    const others = h("input", { type: "checkbox", id: "others", checked: true, change: () => ((this.showsOthers = others.checked), this.choose(this.chosen)) });
    const choice = h("div", { class: "sliders" },
      solutions.length > 1 ? h("div", { class: "slider" }, h("label", { for: "solution" }, `the bold ${one}`), this.input, this.output) : null,
      view && solutions.length > 1 ? h("p", { class: "choices" }, others, " ", h("label", { for: "others" }, `draw the other ${nounOf(data, 2)} faintly`)) : null,
      colours);
    this.element = h("div", {}, view ? h("div", { class: "robot" }, h("div", {}, view.element, floorNote(view, data.drawing?.unit)), choice) : null, robot && pointsTable(robot, this), this.table());
    this.choose(0);
  }

  /** Of the chosen solution; none without a robot. */
  get values(): readonly number[] {
    return this.robot?.places()[this.chosen] ?? [];
  }

  listen(listener: () => void): void {
    this.listeners.push(listener);
  }

  private table(): HTMLElement {
    const { solutions } = this.place;
    const units = this.data.report.solution_units ?? {};
    const names = Object.keys(solutions[0].values);
    const hasLimits = solutions.some(({ limits }) => limits !== "none");
    const head = ["#", ...names.map((name) => (units[name] === "rad" || units[name] === "deg" ? `${name} [°]` : withUnit(name, units[name] === "1" ? undefined : `[${units[name]}]`))), "det", "condition", ...(hasLimits ? ["limits"] : [])];
    const rows = solutions.map(({ values, determinant, condition, limits, beyond }, i) => [
      this.rows[i],
      ...names.map((name) => describeValue(middleOf(values[name]), units[name] === "rad" || units[name] === "deg" ? units[name] : undefined, 8).replace("°", "")),
      SIGNS[determinant],
      condition === null ? "∞" : String(Number(condition.toPrecision(3))),
      ...(hasLimits ? [beyond ?? LIMITS[limits]] : []),
    ]);
    const made = table(head, rows, `All ${solutions.length} in numbers; the report above has the digits that are certain`);
    made.classList.add("solutions");
    return made;
  }

  private choose(i: number): void {
    this.chosen = i;
    this.input.value = String(i + 1);
    const words = `${i + 1} of ${this.place.solutions.length}`;
    this.output.textContent = words;
    this.input.setAttribute("aria-valuetext", words);
    this.rows.forEach((row, k) => {
      row.setAttribute("aria-pressed", String(k === i));
      row.closest("tr")?.classList.toggle("chosen", k === i);
    });
    if (!this.view) return;
    for (const listener of this.listeners) listener();
    this.view.show(this.points[i]);
    this.view.showGhosts(this.showsOthers ? this.points.filter((_, k) => k !== i) : []);
  }
}

/** Shows the robot at a place; without a drawing the table alone. Returns the view, if there is one. */
function showPlace(data: PageData, place: Place, figure: HTMLElement): RobotView | null {
  const { solutions, given } = place;
  if (solutions.length === 0) {
    figure.replaceChildren(h("p", {}, "No solution is certain here, so there is nothing to draw."));
    return null;
  }
  const names = [...new Set([...Object.keys(solutions[0].values), ...Object.keys(given)])];
  const values = solutions.map((solution) => names.map((name) => (solution.values[name] ? middleOf(solution.values[name]) : given[name])));
  const robot = data.drawing ? new SolvedRobot(data.drawing, names, values) : null;
  const view = robot ? new RobotView(robot, data.report.model, data.drawing?.unit, true) : null;
  if (robot && view) view.show(robot.at(values[0]));
  figure.replaceChildren(new Chooser(data, place, robot, view, view && legColours(data, view)).element);
  return view;
}

export function solutionsPart(data: PageData): HTMLElement {
  const places = placesOf(data);
  const total = data.report.places?.length ?? 1;
  const [first] = places;
  const count = first.solutions.length;
  const title = total > 1 ? `The solutions at ${total} places`
    : count === 0 ? "The solutions"
    : !data.drawing ? `${data.report.verdict === "complete" ? "All" : "The"} ${count} ${nounOf(data, count)}`
    : data.report.verdict === "complete" ? `The robot in ${count === 1 ? "its only" : `all ${count}`} ${nounOf(data, count)}`
    : `The robot in the ${count} ${nounOf(data, count)} that ${count === 1 ? "is" : "are"} certain`;
  const figure = h("div", {});
  let view = showPlace(data, first, figure);
  const choose = (): void => {
    view?.dispose();
    view = showPlace(data, places[Number(select.value)], figure);
  };
  const select: HTMLSelectElement = h("select", { id: "place", change: choose },
    ...places.map((place, i) => h("option", { value: i }, place.title)));
  const parts: Child[] = [
    data.drawing ? null : h("p", {}, "The model gives equations and no points, so there is no robot to draw: the table has the values of its unknowns."),
    total > 1 ? h("p", { class: "choices" }, h("label", { for: "place" }, "place"), select) : null,
    places.length < total ? h("p", {}, `The first ${places.length} places can be drawn here; the report has all.`) : null,
    figure,
  ];
  return section(title, ...parts);
}
