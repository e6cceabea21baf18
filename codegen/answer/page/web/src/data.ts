// SPDX-License-Identifier: GPL-3.0-or-later
// The data of a page, as codegen/answer/page/page_data.cpp writes it.
import { Damage } from "./expression";
import type { Check, Enclosure, Path, Point, Solutions, SolutionsAtPlaces, Witness } from "./report_types"; // made from the table of keys
import { sha256 } from "./sha256";

export type { Solution, SolvedPlace, TwistColumn } from "./report_types";

export type Bounds = Enclosure;
export type ReportedPoint = Pick<Point, "parameters" | "pose" | "uncertain">;
export type Degeneracy = Pick<Witness, "nullity" | "singular_values" | "twist" | "rows">;
/** Of the other questions what the page reads of them. */
type Solved = Partial<Pick<Solutions, "solution_units" | "solutions" | "open_boxes"> & Pick<SolutionsAtPlaces, "places" | "places_file">>;
/** The report of a motion, or of one along way-points, which has the segment of the singular pose. */
export type Report = Omit<Check, "proof" | "verdict"> & { readonly verdict: Check["verdict"] | Solutions["verdict"] } & Partial<Pick<Path, "segment">> & Solved;

export interface DrawnPart {
  readonly kind: "base" | "platform" | "leg" | "link" | "rail" | "joint" | "tool";
  readonly row: number;
  readonly points: readonly number[]; // of `points`
}

export interface DrawingData {
  readonly unit: string; // of lengths
  readonly lets: readonly (readonly [string, string])[];
  readonly points: readonly (readonly [string, string, string])[];
  readonly parts: readonly DrawnPart[];
}

export interface Stretch {
  readonly kind: string; // a claim
  readonly segments: readonly [number, number]; // from 1
  readonly s: readonly [number, number]; // in the first and in the last of them
}

export interface PavingData {
  readonly summary: Record<string, any>;
  readonly tree?: string | null;
  readonly stretches?: readonly Stretch[] | null;
}

/** The way-points of a motion. */
export interface WayData {
  readonly file: string;
  readonly interpolation: string;
  readonly time_unit: string | null; // null: there are no times
  readonly pieces: readonly { readonly lines: readonly [number, number]; readonly times: readonly [number, number] }[];
  /** The question about the piece with the singular pose. */
  readonly deciding_question?: string;
}

export interface PageData {
  readonly format: 1;
  readonly version: string;
  readonly command: string;
  readonly again: readonly string[]; // commands
  /**
   * Of the answer that the page is about; "closure" is a check of a mechanism that is given by equations. Only a
   * check has a proof that a page does again.
   */
  readonly kind: "check" | "closure" | "paving" | "margin" | "bound" | "load" | "load-paving" | "datasheet" | "solutions";
  readonly headline: string;
  readonly text: string; // the report for people; empty for a check
  readonly report: Report;
  readonly units: Record<string, string>; // by parameter
  readonly question: string;
  readonly certificate: string | null;
  readonly certificate_note: string;
  readonly model: { readonly file: string; readonly text: string };
  readonly drawing: DrawingData | null;
  readonly paving: PavingData | null;
  readonly way: WayData | null;
  readonly bounds: readonly any[];
  readonly margins: readonly any[];
}

/** Reads the data of this page. Throws Damage unless they are those that were written. */
export function readPageData(): PageData {
  const element = document.getElementById("data");
  const text = element?.textContent;
  if (!element || !text) throw new Damage("the page has no data");
  if (sha256(text) !== element.dataset.sha256)
    throw new Damage("the data of the page are not those that Regulus wrote: their SHA-256 differs");
  const data = JSON.parse(text) as PageData;
  if (data.format !== 1) throw new Damage("the data of the page have an unknown format");
  if (sha256(data.model.text) !== data.report.model_sha256)
    throw new Damage("the model text is not that of the report: its SHA-256 differs");
  return data;
}
