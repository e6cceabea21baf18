// SPDX-License-Identifier: GPL-3.0-or-later
// The segments of a motion along way-points: a strip with what is certified, det as sampled, and a table.
import { h, section, svg, table } from "./dom";
import { approximateDeterminant } from "./matrices";
import { Claim, CLAIM_WORDS, claimOfWord } from "./slices";
import { Tree } from "./tree";
import { Way } from "./way";
import { shortNumber, withUnit } from "./units";

const WIDTH = 800;
const HEIGHT = 120;
const SAMPLES = 600;
const MOST_ROWS = 2000;
const LEAST_WIDTH = 3;
const MOST_PARTS = 4; // of a segment with the same claim

interface Stripe {
  readonly claim: Claim;
  readonly begin: number; // u
  readonly end: number;
}

/** What a check says of a branch: that it is regular all along the way, or up to a segment. */
function stripesOfBranch({ count, data: { report } }: Way): Stripe[] {
  const followed = report.verdict === "no-singularity" ? count : report.verdict === "singularity" && report.segment ? report.segment.segment - 1 : 0;
  const stripes: Stripe[] = [
    { claim: "free", begin: 0, end: followed },
    { claim: "undecided", begin: followed, end: count },
  ];
  return stripes.filter(({ begin, end }) => begin < end);
}

/** The claims along the way: of a paving, or of the proof of each piece. */
function stripesOf(way: Way, trees: readonly Tree[] | null): Stripe[] {
  const stretches = way.data.paving?.stretches;
  if (trees)
    return trees.map((tree, piece) => {
      const isOutside = tree.leaves.every(({ word }) => word === "outside");
      return { claim: isOutside ? "outside" : "free", begin: piece, end: piece + 1 };
    });
  if (stretches)
    return stretches.map(({ kind, segments, s }) => ({
      claim: claimOfWord(kind, true),
      begin: segments[0] - 1 + s[0],
      end: segments[1] - 1 + s[1],
    }));
  return way.data.kind === "closure" ? stripesOfBranch(way) : [{ claim: "undecided", begin: 0, end: way.count }];
}

/** det along the way, in doubles; the line in the middle is 0. */
function sampledCurve(way: Way): SVGElement[] {
  const { columns, hasDeterminant } = way.question(0);
  if (!hasDeterminant) return [];
  const samples = Array.from({ length: SAMPLES + 1 }, (_, i) => {
    const { piece, s } = way.split((way.count * i) / SAMPLES);
    const question = way.question(piece);
    const found = question.approximateAt([s]);
    return approximateDeterminant(question.matrix.map((id) => found[id]), columns);
  });
  const largest = Math.max(...samples.filter(Number.isFinite).map(Math.abs), 1e-300);
  const places = samples.flatMap((det, i) =>
    Number.isFinite(det) ? [`${((i / SAMPLES) * WIDTH).toFixed(1)} ${((0.5 - (0.45 * det) / largest) * HEIGHT).toFixed(1)}`] : []);
  return [
    svg("path", { d: `M0 ${HEIGHT / 2}H${WIDTH}`, class: "zero-line" }),
    svg("path", { d: places.length > 0 ? `M${places.join("L")}` : "M0 0", class: "sample-curve" }),
  ];
}

/** What is not free is drawn wide enough to be seen. */
function shownEnds(x: (u: number) => number, { claim, begin, end }: Stripe): [number, number] {
  const [left, right] = [x(begin), x(end)];
  const more = claim === "free" ? 0 : Math.max(0, LEAST_WIDTH - (right - left)) / 2;
  return [Math.max(0, left - more), Math.min(WIDTH, right + more)];
}

function strip(way: Way, stripes: readonly Stripe[]): HTMLElement {
  const x = (u: number): number => (u / way.count) * WIDTH;
  const cross = svg("path", { class: "cross" });
  const picture = svg(
    "svg",
    { viewBox: `0 -2 ${WIDTH} ${HEIGHT + 4}`, role: "img", "aria-label": "The way from its beginning to its end", preserveAspectRatio: "none" },
    ...[...stripes].sort((a, b) => Number(b.claim === "free") - Number(a.claim === "free")).map((stripe) => {
      const [left, right] = shownEnds(x, stripe);
      return svg("rect", { x: left.toFixed(2), y: 0, width: (right - left).toFixed(2), height: HEIGHT, class: `box ${stripe.claim}` });
    }),
    ...sampledCurve(way),
    cross,
  );
  picture.addEventListener("click", (event) => {
    const { left, width } = picture.getBoundingClientRect();
    way.set(((event.clientX - left) / width) * way.count);
  });
  const show = (): void => cross.setAttribute("d", `M${x(way.values[0]).toFixed(1)} 0V${HEIGHT}`);
  way.listen(show);
  show();
  return h("figure", { class: "slice way-strip" }, picture, h("figcaption", {}, `${way.about.file}: ${way.describe(0)} to ${way.describe(way.count)}`));
}

/** "certified: no singularity, except from 0.17 to 0.18 s: certified: holds a singularity": the claims of a segment, each with its part. */
function describeClaims(way: Way, piece: number, stripes: readonly Stripe[]): string {
  const here = stripes.flatMap(({ claim, begin, end }) => {
    const [first, last] = [Math.max(begin, piece), Math.min(end, piece + 1)];
    return first < last ? [{ claim, first, last }] : [];
  });
  const widthOf = (claim: Claim): number => here.reduce((sum, part) => (part.claim === claim ? sum + part.last - part.first : sum), 0);
  const claims = [...new Set(here.map(({ claim }) => claim))].sort((a, b) => widthOf(b) - widthOf(a));
  const partsOf = (claim: Claim): string => {
    const parts = here.filter((part) => part.claim === claim);
    const told = parts.slice(0, MOST_PARTS).map(({ first, last }) => way.describePart(piece, first - piece, last - piece));
    return told.join(", ") + (parts.length > told.length ? `, and ${parts.length - told.length} more parts` : "");
  };
  const [most, ...others] = claims;
  return [CLAIM_WORDS[most], ...others.map((claim) => `except ${partsOf(claim)}: ${CLAIM_WORDS[claim]}`)].join("; ");
}

function segments(way: Way, stripes: readonly Stripe[], trees: readonly Tree[] | null): HTMLElement {
  const unit = way.about.time_unit;
  const claimOf = (piece: number): string => describeClaims(way, piece, stripes);
  const columns: { head: string; of: (piece: number) => Node | string }[] = [
    { head: "segment", of: (piece) => h("button", { type: "button", class: "row", click: () => way.set(piece + 0.5) }, String(piece + 1)) },
    { head: "lines of the file", of: (piece) => [...new Set(way.about.pieces[piece].lines)].join(", ") },
    ...(unit === null ? [] : [{ head: "time", of: (piece: number) => withUnit(way.about.pieces[piece].times.map(shortNumber).join(" to "), unit) }]),
    { head: "claim", of: claimOf },
    ...(trees ? [{ head: "boxes of the proof", of: (piece: number) => String(trees[piece].leaves.length) }] : []),
  ];
  const shown = Array.from({ length: Math.min(way.count, MOST_ROWS) }, (_, piece) => columns.map(({ of }) => of(piece)));
  const list = table(columns.map(({ head }) => head), shown, "Segments of the way");
  const rest = way.count - shown.length;
  return h("details", { open: way.count <= 12, id: "segments" }, h("summary", {}, `${way.count} segments`), list, rest > 0 ? h("p", {}, `and ${rest} more`) : null);
}

/** Each piece of a proof has a tree. */
export function wayPart(way: Way, trees: readonly Tree[] | null): HTMLElement {
  const stripes = stripesOf(way, trees);
  const claims = [...new Set(stripes.map(({ claim }) => claim))];
  const legend = h(
    "ul",
    { class: "legend" },
    ...claims.map((claim) => h("li", {}, h("span", { class: `key ${claim}` }), CLAIM_WORDS[claim])),
    way.question(0).hasDeterminant ? h("li", {}, h("span", { class: "key dashed" }), "dashed: det as sampled, not proved; the line is 0") : null,
  );
  const about = trees || way.data.paving?.stretches || way.data.kind === "closure"
    ? "From left to right, the way from its first to its last way-point; colours are certified."
    : way.question(0).isClosure
    ? "From left to right, the way from its first to its last way-point. A paving says what is certified of its parts."
    : "The proof is about one pose of the way. Add --paving for what is certified of the rest; the samples below prove nothing.";
  const hint = h("span", { class: "on-screen" }, ` Click, or choose a segment, ${way.data.drawing ? "to move the robot there" : "for the pose there"}.`);
  return section("Along the way-points", h("p", {}, about, hint), legend, strip(way, stripes), segments(way, stripes, trees));
}
