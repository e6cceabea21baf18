// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict, what it does not mean, and the second proof in this browser.
import { PageData } from "./data";
import { h, section } from "./dom";
import { Damage } from "./expression";
import { Question } from "./question";
import { proveTree, Progress } from "./reproof";
import { proveSignChange, proveSmallDeterminant, readWitness } from "./sign_change";
import { readTree, readTrees, Tree } from "./tree";
import { exactDecimal, exactDegrees, describeEnd, describeRange, describeValue, withUnit } from "./units";

const WORDS = { "no-singularity": "NO SINGULARITY", singularity: "SINGULARITY", "possible-problem": "POSSIBLE PROBLEM" };

/** The verdict of a check. */
const verdictOf = (data: PageData): keyof typeof WORDS => data.report.verdict as keyof typeof WORDS;

/** The claim and the proof of a certificate, checked against the question of the page. */
export interface Certificate {
  readonly proof: string;
  readonly tree: Tree | null; // of NO SINGULARITY
  readonly trees: readonly Tree[] | null; // of NO SINGULARITY along way-points
  readonly witnessed: Question; // of the witness of SINGULARITY
}

/** Throws Damage unless the certificate is about the page's question and verdict. */
export function readCertificate(data: PageData, question: Question): Certificate | null {
  if (data.certificate === null) return null;
  const lines = data.certificate.split("\n");
  const head = lines.indexOf("proof");
  const verdict = WORDS[verdictOf(data)];
  if (lines[0] !== "regulus-certificate 1" || head < 0 || lines[1] !== `verdict ${verdict}`)
    throw new Damage("the certificate does not claim the verdict of the page");
  const isFree = data.report.verdict === "no-singularity";
  const about = lines.slice(3, head).join("\n") + "\n";
  const piece = isFree ? undefined : data.way?.deciding_question;
  if (about !== (piece ?? data.question)) throw new Damage("the certificate is about another question than the page");
  const proof = lines.slice(head + 1).join("\n");
  const trees = isFree && question.isPiecewise ? readTrees(proof, question.box) : null;
  if (trees && trees.length !== question.pieces) throw new Damage("the proof has not one tree for each segment");
  const tree = isFree && !trees ? readTree(proof, question.box) : null;
  return { proof, tree, trees, witnessed: piece === undefined ? question : new Question(piece) };
}

/** Throws Damage unless the words that the page began with are those of its data. */
export function requireSameWords(data: PageData): void {
  const headline = document.getElementById("verdict")?.textContent;
  const claim = document.getElementById("claim")?.textContent;
  const isOther = data.kind === "check" && headline !== WORDS[verdictOf(data)];
  const counted = data.kind === "solutions" && data.report.solutions ? /\d+/.exec(headline ?? "")?.[0] ?? "0" : null;
  if (counted !== null && Number(counted) !== data.report.solutions?.length)
    throw new Damage("the headline has another number of solutions than the data");
  if (isOther || headline !== data.headline || claim !== (data.report.claim ?? ""))
    throw new Damage("the verdict in words is not that of the data");
}

const LIMITS: Record<keyof typeof WORDS, string[]> = {
  "no-singularity": [
    "It holds for every pose of this motion, not beyond it.",
    "It does not say how close a singularity is: bounds of forces, speeds or the least singular value do.",
  ],
  singularity: [
    "It shows one singular pose; there may be more.",
    "It does not say that a motion of yours meets it: ask about that motion.",
  ],
  "possible-problem": ["It claims nothing: neither a proof nor a singular pose was found.", "More time, a smaller motion or another method may decide."],
};

const QUOTED = "Regulus has proved what it claims; this page quotes it and has no proof of it.";

/** Says where the proof of an answer is that the page has not. */
function quoted(data: PageData): string {
  if (data.certificate_note) return `Regulus has proved what it claims; this page quotes it. There is no proof in a file: ${data.certificate_note}.`;
  const how = data.command ? "The command below, with --certificate, writes one" : "The question, asked with a certificate, writes one";
  return `${QUOTED} ${how}${data.kind === "solutions" ? ", if such a list has a proof" : ""}.`;
}

const HELD = "Regulus has proved what it claims. This page has the proof, and does not run it: save it, and let regulus verify check it.";

/** A note beside a proof says what it lacks. */
const held = (data: PageData): string => (data.certificate_note ? `${HELD} Of the proof ${data.certificate_note}.` : HELD);

/** The claim in the words of a machine's user, as the report has it; null if nothing is proved. */
function meaning({ report }: PageData): HTMLElement | null {
  return report.meaning ? h("p", { class: "meaning" }, `In other words: ${report.meaning}.`) : null;
}

/** Why nothing was proved, and where; null if something was. */
function obstacle({ report, units }: PageData): HTMLElement | null {
  if (report.verdict !== "possible-problem") return null;
  const ranges = Object.entries(report.blocking_box ?? {}).map(([name, [lo, hi]]) =>
    lo === hi && lo !== null ? `${name} = ${describeValue(lo, units[name])}` : `${name} from ${describeRange(lo ?? -Infinity, hi ?? Infinity, units[name])}`);
  return h("p", {}, `Reason: ${report.reason}.`, ranges.length > 0 ? ` The box that blocks: ${ranges.join(", ")}.` : "");
}

/** What grows in a margin: the values are v, from `low` to `high`, or to where the answer ends. */
interface Growing {
  readonly kind: "tolerance" | "alpha" | "scale" | "parameter" | "tube";
  readonly groups?: string;
  readonly parameter?: string;
  readonly parameters?: string;
  readonly unit: string | null;
  readonly low: string;
  readonly high: string | null;
}

/** What grows on a page of a margin; null on other pages. */
const growingOf = (data: PageData): Growing | null => (data.kind === "margin" ? data.margins[0].margin : null);

/** "v from 0 cm on" */
function values({ low, high, unit }: Growing): string {
  const told = (value: string): string => withUnit(value, unit ?? undefined);
  return high === null ? `v from ${told(low)} on` : `v from ${told(low)} to ${told(high)}`;
}

/** What grows of the motion, in a sentence; null if its ranges stay as they are. */
function growingMotion(growing: Growing | null): string | null {
  if (growing?.kind === "scale") return `each range times v, ${values(growing)}`;
  return growing?.kind === "parameter" ? `the range of ${growing.parameter} grows with v, ${values(growing)}` : null;
}

/** What grows of the uncertain quantities; null if it is none of them. */
function growingTolerance(growing: Growing | null, isBall: boolean): string | null {
  if (growing?.kind === "tolerance") return `${growing.groups!.split(",").join(", ")}: ${isBall ? "in balls of radius v" : "±v"}, ${values(growing)}`;
  if (growing?.kind !== "tube") return null;
  return `control error of ${growing.parameters?.split(",").join(", ") || "every pose parameter"}: ±v, ${values(growing)}`;
}

/** True of a quantity whose tolerance is what grows. */
function grows(growing: Growing | null, kind: string, group: string, name: string): boolean {
  if (growing?.kind === "tube") return kind === "control" && (!growing.parameters || growing.parameters.split(",").some((p) => name === p || name.startsWith(`${p}_error`)));
  const groups = growing?.kind === "tolerance" ? growing.groups!.split(",") : [];
  return groups.includes(group) || groups.includes(name);
}

/** The ranges and tolerances that were asked about, in a sentence each. */
function asked(data: PageData, question: Question): HTMLElement {
  const growing = growingOf(data);
  const ranges = question.parameters.map(({ name, range: { lo, hi } }) => {
    const [least, most] = [lo, hi].map((end, i) => describeEnd(end, data.report.question?.ranges_exact?.[name]?.[i], data.units[name]));
    return least === most ? `${name} = ${least}` : `${name} from ${least} to ${most}`;
  });
  const formulas = Object.entries(data.report.question?.pose_exact ?? {}).map(([name, text]) =>
    withUnit(`${name} = ${text.length > 120 ? `${text.slice(0, 120)} …` : text}`, data.units[name]));
  const groups = new Map<string, number>();
  const quantities = data.report.question?.uncertain ?? [];
  const isGrowingBall = quantities.some(({ kind, group, name, shape }) => shape === "ball" && grows(growing, kind, group, name));
  for (const { kind, name, group, shape, tolerance_exact, radius_exact, unit } of quantities) {
    const size = radius_exact ?? tolerance_exact;
    if (size === undefined || tolerance_exact === "0" || grows(growing, kind, group, name)) continue;
    const told = (unit === "rad" ? exactDegrees(size) : null) ?? withUnit(exactDecimal(size), unit);
    const words = `${group || name} ${shape === "ball" ? `in balls of radius ${told}` : `±${told}`}`;
    groups.set(words, (groups.get(words) ?? 0) + 1);
  }
  const uncertain = [growingTolerance(growing, isGrowingBall), ...[...groups].map(([words, count]) => (count === 1 ? words : `${words} (${count} quantities)`))]
    .filter((words) => words !== null);
  const growth = growingMotion(growing);
  const motion = data.way ? `${question.pieces} segments along ${data.way.file}` : [...ranges, ...formulas, ...(growth ? [growth] : [])].join("; ");
  return h("dl", { id: "asked" },
    h("dt", {}, "Motion"), h("dd", {}, `${data.report.motion}: ${motion}.`),
    h("dt", {}, "Uncertain"), h("dd", {}, uncertain.length > 0 ? `${uncertain.join("; ")}.` : "nothing: geometry and control are taken as exact."));
}

/** The report for people; of solutions that are all in the table below it only repeats them. */
function reportText(data: PageData): HTMLElement {
  const text = h("pre", { tabindex: 0, "aria-label": "Report" }, data.text);
  if (data.kind !== "solutions") return text;
  return h("details", { open: (data.report.open_boxes ?? []).length > 0 || data.report.places !== undefined }, h("summary", {}, "The report, with all digits that are certain"), text);
}

export function verdictPart(data: PageData, question: Question): HTMLElement {
  const isCheck = data.kind === "check";
  return section(
    "What this means, and what not",
    isCheck ? meaning(data) : reportText(data),
    data.kind === "solutions" ? null : asked(data, question),
    isCheck ? obstacle(data) : null,
    h(
      "ul",
      {},
      ...(isCheck ? LIMITS[verdictOf(data)] : [data.certificate === null ? quoted(data) : held(data)]).map((text) => h("li", {}, text)),
      h("li", {}, "It is about the robot as the model describes it: these numbers, these tolerances. It cannot know the robot on your floor."),
      h("li", {}, "Collisions, joint limits that the model does not state, and dynamics are no part of it."),
    ),
    h("p", {}, `Regulus is a program that proves or refutes that a robot meets a singular pose; its proofs can be checked without it${isCheck ? ", as this page does" : ""}.`),
  );
}

/** Gives the verdict its colour: only one that this browser has proved has it, or one that claims nothing. */
function colour(verdict: keyof typeof WORDS): void {
  const line = document.getElementById("verdict");
  if (line) line.className = verdict;
}

function say(text: string, state: string): void {
  const line = document.getElementById("again");
  if (!line) return;
  line.textContent = text;
  line.className = state;
}

function summary(verdict: keyof typeof WORDS, { proved, total, undecided, outside }: Progress): void {
  if (outside === total) say("NOT RE-PROVED: every box is outside the constraints, so that no pose remains.", "partly");
  else if (undecided === 0) {
    colour(verdict);
    say(`RE-PROVED IN THIS BROWSER: ${proved} of ${total} ${total === 1 ? "box" : "boxes"}`, "proved");
  } else if (proved === 0) say("NOT RE-PROVED: the simpler test of this page decides no box; regulus verify has more tests.", "partly");
  else
    say(`RE-PROVED IN THIS BROWSER: ${proved} of ${total} boxes. The simpler test of this page does not decide the other ${undecided}; regulus verify has more tests.`, "partly");
}

/** Proves trees one after the other, each with its question, as one. */
function* proveTrees(questionOf: (piece: number) => Question, trees: readonly Tree[]): Generator<Progress, Progress> {
  const total = trees.reduce((sum, tree) => sum + tree.leaves.length, 0);
  let before: Progress = { proved: 0, undecided: 0, outside: 0, parts: 0, total };
  const added = (state: Progress): Progress => ({
    proved: before.proved + state.proved,
    undecided: before.undecided + state.undecided,
    outside: before.outside + state.outside,
    parts: before.parts + state.parts,
    total,
  });
  for (const [piece, tree] of trees.entries()) {
    const work = proveTree(questionOf(piece), tree, before.parts);
    let step = work.next();
    for (; !step.done; step = work.next()) yield added(step.value);
    before = added(step.value);
  }
  return before;
}

/** Proves in slices of a few milliseconds. */
function proveInSlices(verdict: keyof typeof WORDS, work: Generator<Progress, Progress>, ended: () => void): void {
  const step = (): void => {
    const until = performance.now() + 25;
    try {
      for (;;) {
        const next = work.next();
        if (next.done) {
          summary(verdict, next.value);
          return ended();
        }
        if (performance.now() > until) {
          say(`Proving again: ${next.value.proved} of ${next.value.total} boxes …`, "working");
          break;
        }
      }
    } catch (error) {
      say(`NOT RE-PROVED: ${String(error)}`, "failed");
      return ended();
    }
    setTimeout(step, 0);
  };
  step();
}

/** Proves that a determinant vanishes, or is small. */
function proveWitness(verdict: keyof typeof WORDS, { proof, witnessed }: Certificate): void {
  const witness = readWitness(proof, witnessed);
  if (witness.reason === "small-determinant" && proveSmallDeterminant(witnessed, witness.points[0])) {
    colour(verdict);
    return say("RE-PROVED IN THIS BROWSER: the determinant is certainly within the threshold at a pose next to the witness.", "proved");
  }
  const found = witness.reason === "always-singular" ? null : proveSignChange(witnessed, witness.points[0]);
  if (!found) return say("NOT RE-PROVED: this needs more digits or algebra than this page has; regulus verify has them.", "partly");
  colour(verdict);
  say("RE-PROVED IN THIS BROWSER: the determinant has certain, opposite signs at two poses near the witness, and is defined between them.", "proved");
}

function prove(data: PageData, question: Question, certificate: Certificate, ended: () => void): void {
  const verdict = verdictOf(data);
  if (certificate.tree) return proveInSlices(verdict, proveTree(question, certificate.tree), ended);
  if (certificate.trees) return proveInSlices(verdict, proveTrees((piece) => new Question(data.question, piece), certificate.trees), ended);
  proveWitness(verdict, certificate);
  ended();
}

/** Proves the verdict again, says in the page's header how far it came, and offers to do it once more. */
export function proveAgain(data: PageData, question: Question, certificate: Certificate | null): void {
  if (data.kind !== "check")
    return say(data.certificate !== null
      ? "Quoted: this page does not run the proof that it has; regulus verify does."
      : data.certificate_note
      ? "Quoted: this answer has no proof in a file."
      : "Quoted: this page has no proof of this answer.", "partly");
  if (verdictOf(data) === "possible-problem") {
    colour("possible-problem");
    return say("Nothing is claimed, so there is nothing to prove again.", "partly");
  }
  if (!certificate) return say(`NOT RE-PROVED: this page has no certificate. ${data.certificate_note}`, "partly");
  const run = (): void => {
    button.disabled = true;
    document.getElementById("verdict")!.className = "unchecked";
    say("Not checked yet: the proof in this page is run now.", "working");
    // The page shows these words first.
    setTimeout(() => prove(data, question, certificate, () => (button.disabled = false)), 50);
  };
  const button = h("button", { type: "button", id: "prove-again", click: run }, "Prove it again here");
  document.getElementById("again")?.after(button);
  run();
}
