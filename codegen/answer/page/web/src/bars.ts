// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets as bars: solid from 0 as far as the value is certain, hatched over the bracket in which it lies.
import { PageData } from "./data";
import { h, section, table } from "./dom";
import { shortNumber, withUnit } from "./units";

interface Bar {
  readonly label: string;
  readonly unit: string; // "1" or "": none
  readonly low: number | null; // null: not known
  readonly high: number | null;
  readonly isUnbounded?: boolean;
}

/** What bars of one unit are drawn to: from 0 or below it to 0 or above it. */
interface Scale {
  readonly lo: number;
  readonly hi: number;
}

function scaleOf(list: readonly Bar[]): Scale {
  const ends = list.flatMap(({ low, high }) => [low, high]).filter((end): end is number => end !== null && Number.isFinite(end));
  return { lo: Math.min(0, ...ends), hi: Math.max(1e-300, ...ends) };
}

function textOf({ low, high, unit, isUnbounded }: Bar): string {
  if (isUnbounded) return "unbounded: a singular pose";
  if (low === null && high === null) return "nothing known";
  if (high === null) return `at least ${withUnit(shortNumber(low!), unit)}`;
  if (low === null) return `at most ${withUnit(shortNumber(high), unit)}`;
  return withUnit(`${shortNumber(low)} … ${shortNumber(high)}`, unit);
}

/** A part of a bar between two values. */
function stretch(name: string, from: number, to: number, { lo, hi }: Scale): HTMLElement {
  const part = (value: number): number => (100 * (Math.min(Math.max(value, lo), hi) - lo)) / (hi - lo);
  const element = h("span", { class: name });
  element.style.left = `${part(from)}%`;
  element.style.width = `${part(to) - part(from)}%`;
  return element;
}

/** Texts stand beside the bars and not in them, so that they have the room that they need. */
function barRow(bar: Bar, scale: Scale): HTMLElement[] {
  const [low, high] = [bar.low ?? -Infinity, bar.high ?? Infinity];
  const certain = low > 0 ? [0, low] : high < 0 ? [high, 0] : [0, 0];
  return [
    h("span", { class: "bar-label" }, bar.label),
    h("span", { class: "bar" }, stretch("solid-bar", certain[0], certain[1], scale), stretch("open-bar", low, high, scale), stretch("zero", 0, 0, scale)),
    h("span", { class: "bar-text" }, textOf(bar)),
  ];
}

/** Lengths of bars are compared within a unit alone. */
function bars(list: readonly Bar[], title: string): HTMLElement {
  const units = [...new Set(list.map(({ unit }) => unit))];
  const rows = units.flatMap((unit) => {
    const ofUnit = list.filter((bar) => bar.unit === unit);
    const scale = scaleOf(ofUnit);
    const head = units.length > 1 ? [h("span", { class: "bar-unit" }, withUnit("in", unit === "1" || unit === "" ? "numbers without unit" : unit))] : [];
    return [...head, ...ofUnit.flatMap((bar) => barRow(bar, scale))];
  });
  const picture = h("div", { class: "bars", role: "img", "aria-label": title }, ...rows);
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `Bars: ${title}` }, picture);
}

/** The numbers of bars: on paper the bars have them. */
function numbers(...of: Parameters<typeof table>): HTMLElement {
  const made = table(...of);
  made.classList.add("figure-table");
  return made;
}

const text = (x: number | null, unit: string): string => (x === null ? "none" : withUnit(shortNumber(x), unit));

function boundFigure(bound: any): HTMLElement {
  const components: any[] = bound.components;
  const list = components.map(({ label, unit, attained, proved, unbounded }): Bar => {
    const [low, high] = bound.least ? [proved, attained] : [attained, proved];
    return { label, unit, low, high, isUnbounded: unbounded };
  });
  return h(
    "figure",
    {},
    h("figcaption", {}, h("strong", {}, bound.bound), `: ${bound.result}`),
    bars(list, bound.bound),
    numbers(
      ["of", ...(bound.least ? ["proved", "attained"] : ["attained", "proved"]), "closed"],
      list.map(({ label, unit, low, high }, i) => [
        label || bound.bound,
        text(low, unit),
        text(high, unit),
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
    h("p", {}, "The attained end is the value at a pose of the motion; no pose has a value beyond the proved end. A bar is solid as far as the value is certain, and hatched over the bracket in which it lies; bars of the same unit have the same scale."),
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
  const at = (value: string): string => withUnit(value, margin.margin.unit ?? "");
  const lower = margin.certified_exact ? `Proved at ${at(margin.certified_exact)}: ${below}.` : "Nothing is proved at the lower end.";
  return margin.refuted_exact ? `${lower} At ${at(margin.refuted_exact)}: ${above}.` : lower;
}

function barOf({ margin, certified, refuted }: any): Bar {
  return { label: margin.groups ?? margin.parameter ?? margin.parameters ?? "", unit: margin.unit ?? "", low: certified, high: refuted };
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
        bars([barOf(margin)], margin.margin.kind),
        h("p", {}, claimsOf(margin)),
      ),
    ),
  );
}
