// SPDX-License-Identifier: GPL-3.0-or-later
// Elements. Texts are set as text, never as HTML.

export type Child = Node | string | null;
export type Attributes = Record<string, string | number | boolean | ((event: any) => void)>;

function fillElement(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (typeof value === "boolean") element.toggleAttribute(name, value);
    else element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null));
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fillElement(element, attributes, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fillElement(element, attributes, children);
  return element;
}

let sections = 0;

/** Returns a part of the page with a heading. */
export function section(title: string, ...children: Child[]): HTMLElement {
  const id = `part-${++sections}`;
  return h("section", { "aria-labelledby": id }, h("h2", { id }, title), ...children);
}

export function table(head: string[], rows: (Node | string)[][], caption?: string): HTMLElement {
  const cells = (tag: "td" | "th", row: (Node | string)[], scope?: string): HTMLElement[] =>
    row.map((cell) => h(tag, scope ? { scope } : {}, cell));
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": caption ?? head.join(", ") },
    h(
      "table",
      {},
      caption ? h("caption", {}, h("span", { class: "caption" }, caption)) : null,
      h("thead", {}, h("tr", {}, ...cells("th", head, "col"))),
      h("tbody", {}, ...rows.map((row) => h("tr", {}, ...cells("td", row)))),
    ),
  );
}
