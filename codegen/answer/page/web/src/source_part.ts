// SPDX-License-Identifier: GPL-3.0-or-later
// The model, and what it takes to prove the verdict again.
import { PageData } from "./data";
import { h, section, table } from "./dom";

function download(name: string, text: string): HTMLElement {
  const link = h("button", { type: "button", click: () => {
    const url = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
    h("a", { href: url, download: name }).click();
    URL.revokeObjectURL(url);
  } }, `Save ${name}`);
  return link;
}

const fileName = (path: string): string => path.split("/").pop() || "model.toml";

/** Only a check is asked again by the command that the page knows; another answer by the one that made it. */
function commandsOf(data: PageData): string {
  if (data.certificate !== null) return data.again.slice(0, 2).filter((command) => command !== "").join("\n");
  return (data.kind === "check" || data.kind === "closure" || !data.command ? data.again.slice(0, 1) : [data.command]).join("\n");
}

/** A search evaluates more boxes than its proof has: a box that it splits is none of the proof. */
const LABELS = { method: "method", boxes: "boxes evaluated, split ones too", reason: "reason" };

export function sourcePart(data: PageData): HTMLElement {
  const licence = document.getElementById("licence")?.textContent ?? "";
  const file = fileName(data.model.file);
  const commands = commandsOf(data); // none of a page that a program made
  return section(
    "Model and proof",
    commands ? h("p", {}, data.certificate === null ? "Ask again:" : "Prove it again, with the separate verifier:") : null,
    commands ? h("pre", { tabindex: 0, "aria-label": "Commands" }, commands) : null,
    h("p", {}, download(file, data.model.text), " ", data.certificate === null ? null : download("proof.txt", data.certificate)),
    table(
      ["property", "value"],
      [
        ["Regulus", data.version],
        ...(data.command ? [["page made by", data.command]] : []),
        ["SHA-256 of the model", data.report.model_sha256],
        ...(["method", "boxes", "reason"] as const).filter((key) => (data.report[key] ?? null) !== null).map((key) => [LABELS[key], String(data.report[key])]),
      ],
      "Versions and hashes",
    ),
    h("details", { open: data.model.text.length < 4000 }, h("summary", {}, `The model, ${file}`), h("pre", { tabindex: 0, "aria-label": "Model" }, data.model.text)),
    h("details", {}, h("summary", {}, "The question, in exact expressions"), h("pre", { tabindex: 0, "aria-label": "Question" }, data.question)),
    h("details", {}, h("summary", {}, "Licence of the three.js that draws the robot"), h("pre", { tabindex: 0, "aria-label": "Licence" }, licence)),
  );
}
