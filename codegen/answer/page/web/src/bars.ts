// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets as bars: solid up to what is certain, hatched up to the other end of the bracket.
import { PageData } from "./data";
import { h, section, svg, table } from "./dom";
import { shortNumber, withUnit } from "./units";

const WIDTH = 600;
let patterns = 0;
const ROW = 30;

interface Bar {
  readonly label: string;
  readonly inner: number | null; // below or at it the bar is solid
  readonly outer: number | null;
  readonly text: string;
}

function bars(list: readonly Bar[], title: string): HTMLElement {
  const largest = Math.max(...list.map((bar) => Math.max(Math.abs(bar.outer ?? 0), Math.abs(bar.inner ?? 0))), 1e-300);
  const id = `open-${++patterns}`;
  const x = (value: number): number => 150 + (Math.abs(value) / largest) * (WIDTH - 330);
  const shapes = list.flatMap((bar, i) => {
    const y = i * ROW + 6;
    const inner = bar.inner ?? bar.outer ?? 0;
    const outer = bar.outer ?? inner;
    return [
      svg("text", { x: 142, y: y + 13, "text-anchor": "end" }, bar.label),
      svg("rect", { x: 150, y, width: x(inner) - 150, height: 18, class: "solid-bar" }),
      svg("rect", { x: x(inner), y, width: Math.max(x(outer) - x(inner), 0), height: 18, class: "open-bar", fill: `url(#${id})` }),
      svg("text", { x: x(Math.max(Math.abs(outer), Math.abs(inner))) + 8, y: y + 13 }, bar.text),
    ];
  });
  const pattern = svg("pattern", { id, width: 6, height: 6, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" }, svg("rect", { width: 2.5, height: 6, class: "sample-line" }));
  const picture = svg("svg", { viewBox: `0 0 ${WIDTH} ${list.length * ROW + 6}`, class: "bars", role: "img", "aria-label": title }, svg("defs", {}, pattern), ...shapes);
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `Bars: ${title}` }, picture);
}

/** The numbers of bars: on paper the bars have them. */
function numbers(...of: Parameters<typeof table>): HTMLElement {
  const made = table(...of);
  made.classList.add("figure-table");
  return made;
}

const text = (x: number | null): string => (x === null ? "none" : shortNumber(x));

function boundFigure(bound: any): HTMLElement {
  const components: any[] = bound.components;
  const list: Bar[] = components.map((c) => {
    const [lower, upper] = bound.least ? [c.proved, c.attained] : [c.attained, c.proved];
    return {
      label: c.label,
      inner: lower,
      outer: upper,
      text: c.unbounded ? "unbounded: a singular pose" : withUnit(`${text(lower)} … ${text(upper)}`, c.unit),
    };
  });
  const ends = bound.least ? ["proved", "attained"] : ["attained", "proved"];
  return h(
    "figure",
    {},
    h("figcaption", {}, h("strong", {}, bound.bound), `: ${bound.result}`),
    bars(list, bound.bound),
    numbers(
      ["of", `${ends[0]} (solid)`, `${ends[1]} (end of the hatched part)`, "closed"],
      list.map((bar, i) => [
        bar.label || bound.bound,
        withUnit(text(bar.inner), components[i].unit),
        withUnit(text(bar.outer), components[i].unit),
        components[i].closed ? "yes" : components[i].reason || "no",
      ]),
      bound.bound,
    ),
  );
}

/** A quantity that was compared with a limit. */
function limitFigure(bound: any): HTMLElement {
  const rows = bound.components.map((c: any) => [c.label || bound.bound, String(c.verdict ?? ""), String(c.reason ?? "")]);
  return h(
    "figure",
    {},
    h("figcaption", {}, h("strong", {}, bound.bound), `: ${bound.result}; the limit is ${withUnit(String(bound.limit), bound.unit)}`),
    table(["of", "against the limit", "reason"], rows, bound.bound),
  );
}

/** "tolerance of base", "range of edge". */
function growing({ kind, groups, parameter, parameters }: any): string {
  const of = groups ?? parameter ?? parameters;
  return of ? `${kind === "parameter" ? "range" : kind} of ${of}` : kind;
}

export function boundsPart(data: PageData): HTMLElement | null {
  if (data.bounds.length === 0) return null;
  const part = section(
    "Bounds over the whole motion",
    h("p", {}, "The attained end is the value at a pose of the motion; no pose has a value beyond the proved end."),
    ...data.bounds.map((bound) => (bound.limit === undefined ? boundFigure(bound) : limitFigure(bound))),
  );
  part.classList.add("bounds");
  return part;
}

/** The claims at both ends. With a limit they are about a matrix of its own, so the limit is named instead. */
function claimsOf(margin: any): string {
  const [below, above] = margin.limit
    ? ["the limit holds at every pose", "it is exceeded at some pose"]
    : [margin.certified_claim, margin.refuted_claim];
  const lower = margin.certified_exact ? `Proved at ${margin.certified_exact}: ${below}.` : "Nothing is proved at the lower end.";
  return margin.refuted_exact ? `${lower} At ${margin.refuted_exact}: ${above}.` : lower;
}

export function marginsPart(data: PageData): HTMLElement | null {
  if (data.margins.length === 0) return null;
  return section(
    "Margins",
    ...data.margins.map((margin) =>
      h(
        "figure",
        {},
        h("figcaption", {}, h("strong", {}, growing(margin.margin)), `: ${margin.bracket}${margin.limit ? `; the limit is ${margin.limit}` : ""}`),
        bars([{ label: margin.margin.groups ?? margin.margin.parameter ?? "", inner: margin.certified, outer: margin.refuted, text: `${text(margin.certified)} … ${text(margin.refuted)}` }], margin.margin.kind),
        h("p", {}, claimsOf(margin)),
      ),
    ),
  );
}
