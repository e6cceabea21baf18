// SPDX-License-Identifier: GPL-3.0-or-later
import { boundsPart, marginsPart } from "./bars";
import { PageData, readPageData } from "./data";
import { h, section } from "./dom";
import { Icicle } from "./icicle";
import { middleOf, poseSliders, Shown, ShownPose } from "./pose";
import { Question } from "./question";
import { Robot } from "./robot";
import { robotPart } from "./robot_part";
import { sharesPart, Slices } from "./slices";
import { solutionsPart } from "./solutions_part";
import { sourcePart } from "./source_part";
import { readTree, Tree } from "./tree";
import { Certificate, proveAgain, readCertificate, requireSameWords, verdictPart } from "./verdict_part";
import { Way, WayRobot, waySlider } from "./way";
import { wayPart } from "./way_part";
import { placeOf, witnessPart } from "./witness_part";

type Parts = (HTMLElement | null)[];

function pavingTree(data: PageData, question: Question): Tree | null {
  return data.paving?.tree ? readTree(data.paving.tree, question.box) : null;
}

/** The parts of a motion over ranges. */
function partsOfRanges(data: PageData, question: Question, certificate: Certificate | null): { parts: Parts; pose: Shown } {
  // A proof that covers everything says more than a paving, whose boxes may be undecided.
  const paving = certificate?.tree ? null : pavingTree(data, question);
  const tree = certificate?.tree ?? paving;
  const pose = new ShownPose(question);
  const robot = data.drawing ? new Robot(data.drawing, question) : null;
  const { element, view } = robotPart(data, robot, pose, poseSliders(pose, data));
  const parts = [
    element,
    // Whether forces hold a load is another question than how far a matrix is from singular.
    data.kind === "load" || data.kind === "load-paving" ? null : new Slices(data, question, pose, tree, paving !== null).element,
    sharesPart(data),
    witnessPart(data, pose, robot, view),
    boundsPart(data),
    // A tree of one box has nothing to show: the slices say so.
    tree && tree.leaves.length > 1 ? new Icicle(question, tree, pose, paving ? "The tree of the paving" : "The tree of the proof", data.units).element : null,
  ];
  return { parts, pose };
}

/** A branch along way-points, at first where it ends. */
function partsOfQuotedWay(data: PageData): Parts {
  const way = new Way(data);
  const { segment } = data.report;
  if (segment) way.set(segment.segment - 1 + middleOf(segment.s ?? [0.5, 0.5]));
  return [section("The motion", waySlider(way, data.units)), wayPart(way, null)];
}

/** Of solutions, and of a mechanism that is given by equations: it cannot be drawn. Their proofs are not run. */
function partsOfQuoted(data: PageData, question: Question): Parts {
  if (data.kind === "solutions") return [solutionsPart(data)];
  if (data.way) return partsOfQuotedWay(data);
  const paving = pavingTree(data, question);
  if (!paving) return [];
  const pose = new ShownPose(question);
  return [
    section("The motion", poseSliders(pose, data)),
    new Slices(data, question, pose, paving, true).element,
    sharesPart(data),
    new Icicle(question, paving, pose, "The tree of the paving", data.units).element,
  ];
}

/** The parts of a motion along way-points. */
function partsOfWay(data: PageData, certificate: Certificate | null): { parts: Parts; pose: Shown } {
  const way = new Way(data);
  const robot = data.drawing ? new WayRobot(data.drawing, way) : null;
  const { element, view } = robotPart(data, robot, way, waySlider(way, data.units));
  const parts = [element, wayPart(way, certificate?.trees ?? null), witnessPart(data, way, robot, view), boundsPart(data)];
  return { parts, pose: way };
}

function build(main: HTMLElement): void {
  const data = readPageData();
  requireSameWords(data);
  const question = new Question(data.question);
  const isQuoted = question.isClosure || data.kind === "solutions";
  const certificate = isQuoted ? null : readCertificate(data, question);
  const { parts, pose } = isQuoted
    ? { parts: partsOfQuoted(data, question), pose: null }
    : data.way ? partsOfWay(data, certificate) : partsOfRanges(data, question, certificate);
  const all = [verdictPart(data, question), ...parts, marginsPart(data), sourcePart(data)];
  main.replaceChildren(...all.filter((part): part is HTMLElement => part !== null));
  document.querySelector("header")?.prepend(h("p", { id: "subject" }, data.report.model));
  const place = pose && placeOf(data);
  if (place) pose.goTo(place.point);
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
  document.getElementById("subject")?.remove();
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
