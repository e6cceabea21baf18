// SPDX-License-Identifier: GPL-3.0-or-later
import { boundsPart, marginsPart } from "./bars";
import { PageData, readPageData } from "./data";
import { h, section, shortNumber, table, withUnit } from "./dom";
import { lengthColour } from "./robot";
import { Icicle } from "./icicle";
import { poseSliders, ShownPose } from "./pose";
import { Question } from "./question";
import { Robot } from "./robot";
import { RobotView } from "./robot_view";
import { Slices } from "./slices";
import { sourcePart } from "./source_part";
import { readTree, Tree } from "./tree";
import { proveAgain, readCertificate, requireSameWords, verdictPart } from "./verdict_part";
import { goTo, placeOf, witnessPart } from "./witness_part";

function pointsTable(robot: Robot, pose: ShownPose): HTMLElement {
  const body = h("div", {});
  const show = (): void => {
    const rows = robot.at(pose.values).map((point, i) => [String(i + 1), ...point.map(shortNumber)]);
    body.replaceChildren(table(["point", "x", "y", "z"], rows, "Points of the robot"));
  };
  pose.listen(show);
  show();
  return h("details", { id: "points" }, h("summary", {}, "Points of the robot as numbers"), body);
}

function legLegend(view: RobotView, unit: string | undefined): HTMLElement | null {
  const { lo, hi } = view.lengthRange;
  if (!(hi > lo)) return null;
  const bar = h("span", { class: "gradient", "aria-hidden": "true" });
  bar.style.background = `linear-gradient(to right, ${[0, 1 / 3, 2 / 3, 1].map(lengthColour).join(", ")})`;
  return h("p", { class: "leg-legend" }, `length of a leg: ${shortNumber(lo)} `, bar, withUnit(` ${shortNumber(hi)}`, unit));
}

function robotPart(data: PageData, question: Question, pose: ShownPose): { element: HTMLElement; robot: Robot | null; view: RobotView | null } {
  const sliders = poseSliders(pose, data);
  if (!data.drawing) {
    const note = h("p", {}, "The model gives a matrix and no points, so there is no robot to draw; a [drawing] table in the model adds them.");
    return { element: section("The motion", note, sliders), robot: null, view: null };
  }
  const robot = new Robot(data.drawing, question);
  const view = new RobotView(robot, data.report.model);
  view.show(robot.at(pose.values));
  pose.listen(() => view.show(robot.at(pose.values)));
  const linear = data.units["x"];
  const element = section("The robot", h("div", { class: "robot" }, view.element, h("div", {}, sliders, legLegend(view, linear))), pointsTable(robot, pose));
  return { element, robot, view };
}

function pavingTree(data: PageData, question: Question): Tree | null {
  if (!data.paving) return null;
  return readTree(data.paving.tree, question.box);
}

function build(main: HTMLElement): void {
  const data = readPageData();
  requireSameWords(data);
  const question = new Question(data.question);
  const certificate = readCertificate(data, question);
  // A proof that covers everything says more than a paving, whose boxes may be undecided.
  const paving = certificate?.tree ? null : pavingTree(data, question);
  const tree = certificate?.tree ?? paving;
  const pose = new ShownPose(question);
  const { element, robot, view } = robotPart(data, question, pose);
  const witness = witnessPart(data, pose, robot, view);
  const parts: (HTMLElement | null)[] = [
    verdictPart(data, question),
    element,
    new Slices(data, question, pose, tree, paving !== null).element,
    witness,
    boundsPart(data),
    tree ? new Icicle(question, tree, pose, paving ? "The tree of the paving" : "The tree of the proof").element : null,
    marginsPart(data),
    sourcePart(data),
  ];
  main.replaceChildren(...parts.filter((part): part is HTMLElement => part !== null));
  const place = placeOf(data);
  if (place) goTo(pose, place.point);
  proveAgain(data, question, certificate);
}

/** A page that is damaged claims nothing. */
function fail(error: unknown): void {
  document.body.classList.add("damaged");
  const words = error instanceof Error ? error.message : String(error);
  document.querySelector("main#contents")?.replaceChildren();
  const verdict = document.getElementById("verdict");
  const again = document.getElementById("again");
  if (again) again.textContent = "";
  if (verdict) {
    verdict.textContent = "THIS PAGE IS DAMAGED";
    verdict.className = "damaged";
  }
  const claim = document.getElementById("claim");
  if (claim) claim.textContent = `It claims nothing: ${words}. Ask for it again, or make it again with regulus report.`;
}

try {
  build(document.getElementById("contents")!);
} catch (error) {
  fail(error);
}
