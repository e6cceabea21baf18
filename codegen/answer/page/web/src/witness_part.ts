// SPDX-License-Identifier: GPL-3.0-or-later
// The witness of a singularity, or the pose nearest to one that was met: its place, the twist that is
// lost there and the rows that are dependent.
import { Degeneracy, PageData, ReportedPoint, TwistColumn } from "./data";
import { Child, h, section, table } from "./dom";
import { middleOf, Shown } from "./pose";
import { Drawable, extentOf, Vector } from "./robot";
import { RobotView } from "./robot_view";
import { describeValue, shortNumber, withUnit } from "./units";

export interface Place {
  readonly point: ReportedPoint;
  readonly degeneracy: Degeneracy;
  readonly isProved: boolean;
}

export function placeOf(data: PageData): Place | null {
  if (data.kind !== "check" && data.kind !== "paving") return null;
  const { witness, nearest_singular: nearest } = data.report;
  if (witness) return { point: witness.near ?? witness.points[0], degeneracy: witness, isProved: true };
  return nearest ? { point: nearest, degeneracy: nearest, isProved: false } : null;
}

/** Velocity and angular velocity of a lost twist; null if the model does not name its columns. */
function twistParts(columns: readonly TwistColumn[], vector: readonly number[]): { v: Vector; w: Vector } | null {
  const v: [number, number, number] = [0, 0, 0];
  const w: [number, number, number] = [0, 0, 0];
  for (const [i, { name }] of columns.entries()) {
    const match = /^([vw])_([xyz])$/.exec(name ?? "");
    if (!match) return null;
    (match[1] === "v" ? v : w)["xyz".indexOf(match[2])] = vector[i];
  }
  return { v, w };
}

/** Moves the platform along a twist, to and fro, as far as a tenth of the robot's size. */
class Swing {
  private frame = 0;

  constructor(
    private readonly robot: Drawable,
    private readonly view: RobotView,
    private readonly pose: Shown,
    private readonly twist: { v: Vector; w: Vector },
  ) {}

  get isRunning(): boolean {
    return this.frame !== 0;
  }

  toggle(): void {
    if (this.isRunning) {
      cancelAnimationFrame(this.frame);
      this.frame = 0;
      this.view.show(this.robot.at(this.pose.values));
    } else {
      this.step(performance.now(), performance.now());
    }
  }

  private step(start: number, now: number): void {
    this.view.show(this.moved(Math.sin((now - start) / 450)));
    this.frame = requestAnimationFrame((next) => this.step(start, next));
  }

  private moved(phase: number): Vector[] {
    const points = this.robot.at(this.pose.values);
    const { v, w } = this.twist;
    const c = this.pose.origin();
    const moving = new Set(this.robot.parts.filter((part) => part.kind === "platform").flatMap((part) => part.points));
    const velocity = (p: Vector): number[] => {
      const r = p.map((x, axis) => x - c[axis]);
      return [v[0] + w[1] * r[2] - w[2] * r[1], v[1] + w[2] * r[0] - w[0] * r[2], v[2] + w[0] * r[1] - w[1] * r[0]];
    };
    const fastest = Math.max(...[...moving].map((i) => Math.hypot(...velocity(points[i]))), 1e-300);
    const scale = (0.1 * extentOf(this.robot).radius * phase) / fastest;
    return points.map((p, i) => (moving.has(i) ? (p.map((x, axis) => x + scale * velocity(p)[axis]) as unknown as Vector) : p));
  }
}

/** The part of the page about the witness; null if there is neither a witness nor a nearest pose. */
export function witnessPart(data: PageData, pose: Shown, robot: Drawable | null, view: RobotView | null): HTMLElement | null {
  const place = placeOf(data);
  if (!place) return null;
  const { point, degeneracy, isProved } = place;
  const buttons: Child[] = [
    h("button", { type: "button", id: "show-witness", click: () => pose.goTo(point) }, "Show this pose"),
  ];
  const { twist, rows } = degeneracy;
  const parts = twist?.vectors[0] ? twistParts(twist.columns, twist.vectors[0]) : null;
  const hasPlatform = robot?.parts.some((part) => part.kind === "platform") ?? false;
  if (robot && view && parts && hasPlatform) {
    const swing = new Swing(robot, view, pose, parts);
    const button = h("button", { type: "button", id: "swing", "aria-pressed": "false", click: () => {
      if (!swing.isRunning) pose.goTo(point);
      swing.toggle();
      button.setAttribute("aria-pressed", String(swing.isRunning));
    } }, "Move along the lost twist");
    buttons.push(" ", button);
  }
  if (view && rows) view.marked = new Set(rows.taking_part.map((row) => row - 1));
  const values = data.way ? { ...point.parameters, ...point.pose } : point.parameters;
  const list = Object.entries(values).map(([name, bounds]) => [name, describeValue(middleOf(bounds), data.units[name], 6)]);
  return section(
    isProved ? "The singular pose" : "The pose to look at",
    h("p", {}, isProved
      ? `Proved: ${data.report.alpha > 0 ? "the determinant is within the threshold" : "the matrix is singular"} at a pose that agrees with this one in the digits shown.`
      : "Sampled, not proved: the smallest singular value that the search met."),
    h("p", {}, ...buttons),
    table(["parameter", "value"], list),
    twist ? h("p", {}, `Lost twist (approximate; ${twist.normalised ?? ""}): `, twist.vectors.map((vector) =>
      vector.map((x, i) => withUnit(`${twist.columns[i]?.name ?? `column ${i + 1}`} = ${shortNumber(x)}`, undefined)).join(", ")).join("; ")) : null,
    rows ? h("p", {}, `Dependent rows${view ? ", in orange in the robot" : ""}: ${rows.taking_part.join(", ")}.`) : null,
    degeneracy.singular_values ? h("p", {}, `Singular values, as parts of the largest (approximate): ${degeneracy.singular_values.map((x) => Number(x.toPrecision(3))).join(", ")}.`) : null,
  );
}
