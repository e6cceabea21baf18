// SPDX-License-Identifier: GPL-3.0-or-later
// A tree of boxes, from the lines `s BOX VARIABLE X` and `l BOX WORD` of a certificate or a paving.
import { Damage, readEnd } from "./expression";
import { Interval } from "./interval";

export interface TreeBox {
  readonly id: number;
  readonly depth: number;
  readonly box: readonly Interval[];
  readonly parent: TreeBox | null;
  variable: number; // of the split; -1: a leaf
  at: number;
  halves: readonly TreeBox[]; // none or two
  word: string; // of a leaf: its rule, or its claim
}

export interface Tree {
  readonly root: TreeBox;
  readonly leaves: readonly TreeBox[];
}

function newBox(id: number, box: readonly Interval[], parent: TreeBox | null): TreeBox {
  const depth = parent ? parent.depth + 1 : 0;
  return { id, depth, box, parent, variable: -1, at: 0, halves: [], word: "" };
}

/**
 * Reads a tree and checks that its leaves tile the box: each box is split inside, or is a leaf, once.
 * Throws Damage otherwise.
 */
export function readTree(text: string, box: readonly Interval[]): Tree {
  const lines = text.split("\n").filter((line) => line !== "");
  const tree = readLines(lines.slice(0, -1), box);
  requireEnd(lines[lines.length - 1] ?? "", tree.leaves.length);
  return tree;
}

/** Reads the trees of all pieces of a motion along way-points, each after a line `tree`. */
export function readTrees(text: string, box: readonly Interval[]): Tree[] {
  const lines = text.split("\n").filter((line) => line !== "");
  const parts: string[][] = [];
  for (const line of lines.slice(0, -1)) {
    if (line === "tree") parts.push([]);
    else if (parts.length === 0) throw new Damage("the trees have no beginning");
    else parts[parts.length - 1].push(line);
  }
  const trees = parts.map((part) => readLines(part, box));
  requireEnd(lines[lines.length - 1] ?? "", trees.reduce((sum, tree) => sum + tree.leaves.length, 0));
  return trees;
}

function requireEnd(line: string, leaves: number): void {
  const count = /^end (\d+)$/.exec(line)?.[1];
  if (count === undefined) throw new Damage("the tree has no end");
  if (Number(count) !== leaves) throw new Damage(`the tree has ${leaves} leaves, and says ${count}`);
}

function readLines(lines: readonly string[], box: readonly Interval[]): Tree {
  const root = newBox(0, box, null);
  const open = new Map<number, TreeBox>([[0, root]]);
  const leaves: TreeBox[] = [];
  let next = 1;
  const take = (id: string): TreeBox => {
    const found = open.get(Number(id));
    if (!found) throw new Damage(`box ${id} of the tree does not wait for a line`);
    open.delete(found.id);
    return found;
  };
  for (const line of lines) {
    const words = line.split(" ");
    if (words[0] === "s" && words.length === 4) {
      const parent = take(words[1]);
      const variable = Number(words[2]);
      const at = readEnd(words[3]);
      const range = parent.box[variable];
      if (!range || !(range.lo < at && at < range.hi))
        throw new Damage(`box ${parent.id} of the tree is not split inside`);
      const half = (part: Interval): TreeBox =>
        newBox(next++, parent.box.map((x, k) => (k === variable ? part : x)), parent);
      parent.variable = variable;
      parent.at = at;
      parent.halves = [half({ lo: range.lo, hi: at }), half({ lo: at, hi: range.hi })];
      for (const child of parent.halves) open.set(child.id, child);
    } else if (words[0] === "l" && words.length === 3) {
      const leaf = take(words[1]);
      leaf.word = words[2];
      leaves.push(leaf);
    } else {
      throw new Damage(`a line of the tree cannot be read: ${line.slice(0, 60)}`);
    }
  }
  if (open.size > 0) throw new Damage(`${open.size} boxes of the tree have no leaf`);
  return { root, leaves };
}

/** Returns the leaves that meet a plane: `fixed` has a value for each variable, or null for all. */
export function leavesAt(tree: Tree, fixed: readonly (number | null)[]): TreeBox[] {
  const found: TreeBox[] = [];
  const visit = (node: TreeBox): void => {
    if (node.halves.length === 0) {
      found.push(node);
      return;
    }
    const value = fixed[node.variable] ?? null;
    // On a cut, the upper part is shown.
    if (value === null || value < node.at) visit(node.halves[0]);
    if (value === null || value >= node.at) visit(node.halves[1]);
  };
  visit(tree.root);
  return found;
}
