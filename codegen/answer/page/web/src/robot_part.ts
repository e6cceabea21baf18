// SPDX-License-Identifier: GPL-3.0-or-later
// The robot with its sliders, the colours of its legs, and its points as numbers.
import { PageData } from "./data";
import { Child, h, section, table } from "./dom";
import { Drawable, scaleColour } from "./robot";
import { LegScale, RobotView } from "./robot_view";
import { shortNumber, withUnit } from "./units";

/** What the page calls when the pose has changed. */
export interface Changing {
  readonly values: ArrayLike<number>;
  listen(listener: () => void): void;
}

/** The largest force in each leg, if a bound of forces in the page has them by leg. */
function forceScales(data: PageData): LegScale[] {
  return data.bounds.flatMap((bound): LegScale[] => {
    if (bound.quantity?.kind !== "force" || bound.least) return [];
    const byRow = new Map<number, number>();
    for (const { label, proved } of bound.components) {
      const number = / (\d+)$/.exec(label ?? "")?.[1];
      if (number && Number.isFinite(proved)) byRow.set(Number(number) - 1, Math.abs(proved));
    }
    if (byRow.size === 0) return [];
    const values = [...byRow.values()];
    return [{ label: `proved bound of the ${bound.bound}`, unit: bound.unit, lo: Math.min(...values), hi: Math.max(...values), byRow }];
  });
}

function legend(scale: LegScale): HTMLElement {
  if (!(scale.hi > scale.lo)) return h("p", { class: "leg-legend" }, `${scale.label}: ${withUnit(shortNumber(scale.hi), scale.unit)} in every leg`);
  const bar = h("span", { class: "gradient", "aria-hidden": "true" });
  bar.style.background = `linear-gradient(to right, ${[0, 1 / 3, 2 / 3, 1].map(scaleColour).join(", ")})`;
  const ends = h("span", { class: "scale" }, `${shortNumber(scale.lo)} `, bar, withUnit(` ${shortNumber(scale.hi)}`, scale.unit));
  return h("p", { class: "leg-legend" }, `${scale.label}: `, ends);
}

/** How large the robot is, and what its lines are. */
export function floorNote(view: RobotView, unit: string | undefined): HTMLElement {
  const axes = view.hasTool ? " Grey cylinders are joints with their axes; the tool has its frame: x pink, y green, z blue." : "";
  return h("p", { class: "note" }, `To scale: a square of the floor is ${withUnit(shortNumber(view.square), unit)} wide.${axes}`);
}

/** The colours of the legs, with a choice if there are several; null if they say nothing. */
export function legColours(data: PageData, view: RobotView): HTMLElement | null {
  const lengths = view.legScale;
  const scales = [...forceScales(data), ...(lengths.hi > lengths.lo ? [lengths] : [])];
  if (scales.length === 0) return null;
  const shown = h("div", {});
  const choose = (scale: LegScale): void => {
    view.legScale = scale;
    shown.replaceChildren(legend(scale));
  };
  choose(scales[0]);
  if (scales.length === 1) return shown;
  const select = h(
    "select",
    { id: "leg-colours", change: () => choose(scales[Number(select.value)]) },
    ...scales.map(({ label }, i) => h("option", { value: i }, label)),
  );
  return h("div", {}, h("label", { for: "leg-colours" }, "colour of a leg"), " ", select, shown);
}

export function pointsTable(robot: Drawable, pose: Changing): HTMLElement {
  const body = h("div", {});
  const show = (): void => {
    const rows = robot.at(pose.values).map((point, i) => [String(i + 1), ...point.map(shortNumber)]);
    body.replaceChildren(table(["point", "x", "y", "z"], rows, "Points of the robot"));
  };
  pose.listen(show);
  show();
  return h("details", { id: "points" }, h("summary", {}, "Points of the robot as numbers"), body);
}

/** Without a robot there are only the sliders. */
export function robotPart(data: PageData, robot: Drawable | null, pose: Changing, sliders: Child): { element: HTMLElement; view: RobotView | null } {
  if (!robot) {
    const note = h("p", {}, "The model gives a matrix and no points, so there is no robot to draw; a [drawing] table in the model adds them.");
    return { element: section("The motion", note, sliders), view: null };
  }
  const view = new RobotView(robot, data.report.model, data.drawing?.unit);
  view.show(robot.at(pose.values));
  pose.listen(() => view.show(robot.at(pose.values)));
  const beside = h("div", {}, sliders, legColours(data, view));
  return { element: section("The robot", h("div", { class: "robot" }, h("div", {}, view.element, floorNote(view, data.drawing?.unit)), beside), pointsTable(robot, pose)), view };
}
