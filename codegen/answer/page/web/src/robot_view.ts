// SPDX-License-Identifier: GPL-3.0-or-later
// The robot in three dimensions, and the same view as SVG for paper and for browsers without WebGL.
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { DrawnPart } from "./data";
import { h, svg } from "./dom";
import { distance, Drawable, Extent, extentOf, scaleColour, Vector } from "./robot";
import { floorOf, Segment, standOf } from "./scenery";
import { roundStep } from "./units";

const COLOURS = { base: "#8a8f98", platform: "#aa6f98", link: "#5f7fb8", rail: "#9aa0a6", joint: "#5f6874", leg: "#888888" };
const TOOL = ["#cc79a7", "#009e73", "#0072b2"]; // x, y, z
const DEPENDENT = "#d55e00";
const GHOST = "#848c97";
const FLOOR = "#8f98a3";

/** What the colours of the legs mean. */
export interface LegScale {
  readonly label: string;
  readonly unit: string | undefined;
  readonly lo: number;
  readonly hi: number;
  /** By row of the matrix; without it the colour is that of the shown length. */
  readonly byRow?: ReadonlyMap<number, number>;
}

/** A cylinder between two points, or about the first of them in the direction of the second. */
interface Rod {
  readonly part: DrawnPart;
  readonly points: readonly [number, number];
  readonly radius: number; // as a part of the robot's size, as are these:
  readonly reach: readonly [number, number] | null; // behind the first point, and before it; null: to the second point
  readonly colour: string | null; // null: by the part
  readonly mesh: Mesh;
}

const RADII: Record<DrawnPart["kind"], number> = { base: 0.014, platform: 0.014, leg: 0.02, link: 0.028, rail: 0.01, joint: 0.042, tool: 0.012 };

export class RobotView {
  readonly element: HTMLElement;
  /** Rows of the matrix whose parts are marked as dependent. */
  marked: ReadonlySet<number> = new Set();
  /** The width of a square of the floor. */
  readonly square: number;
  readonly hasTool: boolean;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 4 / 3, 0.01, 100);
  private readonly rods: Rod[] = [];
  private readonly plates: { part: DrawnPart; mesh: Mesh; rim: Mesh[] }[] = [];
  private readonly knots: { point: number; mesh: Mesh }[] = [];
  private readonly drawing: SVGSVGElement;
  private readonly extent: Extent;
  private readonly floor: readonly Segment[];
  private readonly stand: readonly Vector[]; // corners of the plate that an arm stands on
  private readonly ghostLines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: GHOST, transparent: true, opacity: 0.6 }));
  private ghostSegments: readonly Segment[] = [];
  private renderer: WebGLRenderer | null = null;
  private controls: OrbitControls | null = null;
  private points: Vector[] = [];
  private scale: LegScale;
  private center: Vector;

  /** `showsAll`: all places of the robot are in view from the beginning; otherwise the view grows to them. */
  constructor(private readonly robot: Drawable, name: string, unit: string | undefined, showsAll = false) {
    this.extent = extentOf(robot);
    this.center = this.extent.center;
    this.hasTool = robot.parts.some(({ kind }) => kind === "tool");
    this.square = roundStep(this.extent.radius / 6);
    this.stand = this.hasTool ? standOf(robot, this.extent.size) : [];
    this.floor = floorOf(this.extent, this.square);
    this.scale = { label: this.hasTool ? "travel of a sliding joint" : "length of a leg", unit, ...this.rangeOfLengths() };
    this.drawing = svg("svg", { viewBox: "0 0 800 600", class: "robot-drawing", role: "img", "aria-label": `Drawing of ${name}` });
    const canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": `${name} in three dimensions; arrow keys turn the view, plus and minus zoom` });
    this.element = h("div", { class: "robot-view" }, canvas, this.drawing);
    const inView = showsAll ? this.extent.points : this.drawnOf(robot.at(robot.places()[0]));
    this.lookAt(this.extent.isPlanar ? new Vector3(0, -0.01, 1) : new Vector3(1.9, -2.6, 1.3), [...inView, ...this.stand]);
    this.build();
    this.start(canvas);
  }

  /** Draws these points; `parameters` only matter for the shown lengths. */
  show(points: Vector[]): void {
    this.points = points;
    this.stepBack(this.drawnOf(points));
    for (const rod of this.rods) this.placeRod(rod);
    for (const { part, mesh, rim } of this.plates) this.placePlate(part, mesh, rim);
    for (const { point, mesh } of this.knots) mesh.position.copy(this.local(points[point]));
    this.render();
  }

  /** Gives back what a browser has few of; the view is not shown any more. */
  dispose(): void {
    this.controls?.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
    this.renderer = null;
  }

  /** Draws the robot faintly at other places, too. */
  showGhosts(places: readonly Vector[][]): void {
    const segments = places.flatMap((points) =>
      this.robot.parts.flatMap(({ kind, points: ids }): Segment[] => {
        if (kind === "base" || kind === "joint" || kind === "tool") return [];
        const corners = kind === "platform" ? [...ids, ids[0]] : ids;
        return corners.slice(1).map((id, k) => [points[corners[k]], points[id]]);
      }));
    this.ghostSegments = segments.filter((ends) => ends.flat().every(Number.isFinite));
    this.ghostLines.geometry.dispose();
    this.ghostLines.geometry = this.linesOf(this.ghostSegments);
    this.render();
  }

  colourOf(part: DrawnPart): string {
    if (part.row >= 0 && this.marked.has(part.row)) return DEPENDENT;
    if (part.kind !== "leg") return part.kind === "tool" ? TOOL[0] : COLOURS[part.kind];
    const { lo, hi, byRow } = this.scale;
    const length = distance(this.points[part.points[0]], this.points[part.points[1]]);
    const value = byRow ? (byRow.get(part.row) ?? NaN) : length;
    return Number.isNaN(value) ? COLOURS.rail : scaleColour(hi > lo ? (value - lo) / (hi - lo) : 0.5);
  }

  get legScale(): LegScale {
    return this.scale;
  }

  set legScale(scale: LegScale) {
    this.scale = scale;
    if (this.points.length > 0) this.show(this.points);
  }

  private rangeOfLengths(): { lo: number; hi: number } {
    const legs = this.robot.parts.filter((part) => part.kind === "leg");
    let lo = Infinity;
    let hi = -Infinity;
    for (const place of this.robot.places()) {
      const points = this.robot.at(place);
      for (const { points: [a, b] } of legs) {
        const length = distance(points[a], points[b]);
        if (Number.isFinite(length)) [lo, hi] = [Math.min(lo, length), Math.max(hi, length)];
      }
    }
    // Rods of one length differ by roundings only.
    return hi - lo > 1e-6 * hi ? { lo, hi } : { lo: 0, hi: 0 };
  }

  /** The points that are in view; axes are not. */
  private drawnOf(points: readonly Vector[]): Vector[] {
    const ids = this.robot.parts.flatMap((part) => (part.kind === "joint" || part.kind === "tool" ? part.points.slice(0, 1) : part.points));
    return ids.map((i) => points[i]).filter((point) => point.every(Number.isFinite));
  }

  /** Puts the camera in this direction from the middle of some points, so far away that they fit. */
  private lookAt(direction: Vector3, points: readonly Vector[]): void {
    const toward = direction.clone().normalize();
    const [right, up] = this.acrossAndUp(toward);
    const middle = (axis: Vector3): number => {
      const along = points.map((p) => this.local(p).dot(axis));
      return along.length === 0 ? 0 : (along.reduce((a, b) => Math.min(a, b)) + along.reduce((a, b) => Math.max(a, b))) / 2;
    };
    const shift = right.clone().multiplyScalar(middle(right)).addScaledVector(up, middle(up)).addScaledVector(toward, middle(toward));
    this.center = this.center.map((x, axis) => x + this.extent.radius * shift.getComponent(axis)) as unknown as Vector;
    this.camera.position.copy(toward.multiplyScalar(this.distanceFor(toward, points)));
    this.camera.up.set(0, 0, 1);
    this.camera.lookAt(0, 0, 0);
    this.camera.updateMatrixWorld();
  }

  private acrossAndUp(toward: Vector3): [Vector3, Vector3] {
    const right = new Vector3(0, 0, 1).cross(toward).normalize();
    return [right, toward.clone().cross(right)];
  }

  /** How far away in a direction the camera must be for points to fit. */
  private distanceFor(toward: Vector3, points: readonly Vector[]): number {
    const [right, up] = this.acrossAndUp(toward);
    const half = Math.tan(((this.camera.fov / 2) * Math.PI) / 180) * 0.92;
    const margin = ((this.hasTool ? 0.22 : 0.1) * this.extent.size) / this.extent.radius; // for what is drawn about the points
    return points.reduce((most, point) => {
      const p = this.local(point);
      const wide = (Math.abs(p.dot(right)) + margin) / (half * this.camera.aspect);
      return Math.max(most, p.dot(toward) + Math.max(wide, (Math.abs(p.dot(up)) + margin) / half));
    }, 0.1);
  }

  /** Moves the camera away until points fit. */
  private stepBack(points: readonly Vector[]): void {
    const toward = this.camera.position.clone().normalize();
    const needed = this.distanceFor(toward, points);
    if (needed > this.camera.position.length()) this.camera.position.copy(toward.multiplyScalar(needed));
  }

  /** Coordinates in which the robot has about radius 1 about the origin. */
  private local(point: Vector): Vector3 {
    return new Vector3(...point.map((x, axis) => (Number.isFinite(x) ? (x - this.center[axis]) / this.extent.radius : 1e6)) as [number, number, number]);
  }

  private linesOf(segments: readonly Segment[]): BufferGeometry {
    const numbers = segments.flat().flatMap((point) => this.local(point).toArray());
    return new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3));
  }

  private addMesh(geometry: BufferGeometry, colour: string): Mesh {
    const made = new Mesh(geometry, new MeshStandardMaterial({ color: colour, roughness: 0.55 }));
    this.scene.add(made);
    return made;
  }

  private cylinder(radius: number, colour: string): Mesh {
    const thick = (radius * this.extent.size) / this.extent.radius;
    return this.addMesh(new CylinderGeometry(thick, thick, 1, 20), colour);
  }

  private addRod(part: DrawnPart, points: readonly [number, number], radius = RADII[part.kind], reach: Rod["reach"] = null, colour: string | null = null): void {
    this.rods.push({ part, points, radius, reach, colour, mesh: this.cylinder(radius, colour ?? COLOURS.leg) });
  }

  private build(): void {
    const used = new Set<number>();
    for (const part of this.robot.parts) {
      const ids = part.points;
      if (part.kind === "base" || part.kind === "platform") this.addPlate(part);
      else if (part.kind === "joint") {
        this.addRod(part, [ids[0], ids[1]], RADII.joint, [0.075, 0.075]);
        this.addRod(part, [ids[0], ids[1]], 0.006, [0.2, 0.2]);
      } else if (part.kind === "tool") TOOL.forEach((colour, k) => this.addRod(part, [ids[0], ids[k + 1]], RADII.tool, [0, 0.22], colour));
      else {
        for (let i = 0; i + 1 < ids.length; ++i) this.addRod({ ...part, points: ids.slice(i, i + 2) }, [ids[i], ids[i + 1]]);
        ids.forEach((i) => used.add(i));
      }
    }
    const ball = (0.03 * this.extent.size) / this.extent.radius;
    for (const point of used) this.knots.push({ point, mesh: this.addMesh(new SphereGeometry(ball, 20, 14), COLOURS.joint) });
    if (this.stand.length > 0) this.placeCorners(this.addMesh(new BufferGeometry(), COLOURS.base), this.stand.map((p) => this.local(p)), 0.8);
    this.scene.add(new AmbientLight(new Color("#ffffff"), 1.6));
    const sun = new DirectionalLight(new Color("#ffffff"), 2.2);
    sun.position.set(2, -3, 4);
    this.scene.add(sun, this.ghostLines);
    this.scene.add(new LineSegments(this.linesOf(this.floor), new LineBasicMaterial({ color: FLOOR, transparent: true, opacity: 0.35 })));
  }

  private addPlate(part: DrawnPart): void {
    const colour = COLOURS[part.kind as "base"];
    const rim = part.points.map(() => this.cylinder(RADII[part.kind], colour));
    this.plates.push({ part, mesh: this.addMesh(new BufferGeometry(), colour), rim });
  }

  /** The ends of a rod; what has a reach is about its first point. */
  private endsOf({ points: [from, to], reach }: Rod): [Vector, Vector] {
    const [a, b] = [this.points[from], this.points[to]];
    if (!reach) return [a, b];
    const along = (part: number): Vector => a.map((x, axis) => x + part * this.extent.size * (b[axis] - x)) as unknown as Vector;
    return [along(-reach[0]), along(reach[1])];
  }

  private placeRod(rod: Rod): void {
    const [a, b] = this.endsOf(rod);
    this.stretch(rod.mesh, this.local(a), this.local(b));
    (rod.mesh.material as MeshStandardMaterial).color.set(rod.colour ?? this.colourOf(rod.part));
  }

  private stretch(mesh: Mesh, a: Vector3, b: Vector3): void {
    const along = b.clone().sub(a);
    mesh.visible = along.length() > 1e-9 && along.length() < 1e4;
    mesh.position.copy(a).addScaledVector(along, 0.5);
    mesh.scale.set(1, along.length(), 1);
    mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), along.normalize());
  }

  private placePlate(part: DrawnPart, mesh: Mesh, rim: Mesh[]): void {
    const corners = part.points.map((i) => this.local(this.points[i]));
    rim.forEach((edge, i) => this.stretch(edge, corners[i], corners[(i + 1) % corners.length]));
    this.placeCorners(mesh, corners, 0.35);
  }

  private placeCorners(mesh: Mesh, corners: readonly Vector3[], opacity: number): void {
    const triangles: number[] = [];
    for (let i = 1; i + 1 < corners.length; ++i)
      for (const corner of [corners[0], corners[i], corners[i + 1]]) triangles.push(corner.x, corner.y, corner.z);
    Object.assign(mesh.material, { side: DoubleSide, transparent: true, opacity, depthWrite: false });
    mesh.geometry.setAttribute("position", new BufferAttribute(new Float32Array(triangles), 3));
    mesh.geometry.computeVertexNormals();
    mesh.geometry.computeBoundingSphere();
  }

  private start(canvas: HTMLCanvasElement): void {
    try {
      this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    } catch {
      this.element.classList.add("flat");
      return;
    }
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableZoom = false; // the wheel scrolls the page
    this.controls.addEventListener("change", () => this.render());
    canvas.addEventListener("keydown", (event) => this.turn(event));
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  private turn(event: KeyboardEvent): void {
    const turns: Record<string, [number, number, number]> = {
      ArrowLeft: [-0.1, 0, 1],
      ArrowRight: [0.1, 0, 1],
      ArrowUp: [0, 0.08, 1],
      ArrowDown: [0, -0.08, 1],
      "+": [0, 0, 0.9],
      "-": [0, 0, 1.1],
    };
    const turn = turns[event.key];
    if (!turn) return;
    event.preventDefault();
    const { x, y, z } = this.camera.position;
    const radius = Math.hypot(x, y, z) * turn[2];
    const around = Math.atan2(y, x) + turn[0];
    const height = Math.min(Math.max(Math.asin(z / Math.hypot(x, y, z)) + turn[1], -1.5), 1.5);
    this.camera.position.set(
      radius * Math.cos(height) * Math.cos(around),
      radius * Math.cos(height) * Math.sin(around),
      radius * Math.sin(height),
    );
    this.controls?.update();
    this.render();
  }

  private resize(): void {
    const width = this.element.clientWidth;
    const height = Math.round(Math.min(width * 0.75, 520));
    if (width === 0) return;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.renderer?.setSize(width, height);
    this.render();
  }

  private render(): void {
    if (this.points.length === 0) return;
    this.camera.updateMatrixWorld();
    this.renderer?.render(this.scene, this.camera);
    this.draw();
  }

  /** The same view in SVG, far parts first. */
  private draw(): void {
    const flat = (point: Vector): [number, number, number] => {
      const p = this.local(point).project(this.camera);
      return [400 + 400 * p.x, 300 - 300 * p.y, p.z];
    };
    const path = (segments: readonly Segment[]): string =>
      segments.map(([a, b]) => `M${flat(a).slice(0, 2).map((x) => x.toFixed(1)).join(" ")}L${flat(b).slice(0, 2).map((x) => x.toFixed(1)).join(" ")}`).join("");
    const shapes: { depth: number; shape: SVGElement }[] = [];
    const plate = (points: readonly Vector[], colour: string): void => {
      const corners = points.map(flat);
      const shape = svg("polygon", { points: corners.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" "), fill: colour, "fill-opacity": 0.35, stroke: colour, "stroke-width": 4 });
      shapes.push({ depth: Math.max(...corners.map((c) => c[2])), shape });
    };
    for (const { part } of this.plates) plate(part.points.map((i) => this.points[i]), COLOURS[part.kind as "base"]);
    if (this.stand.length > 0) plate(this.stand, COLOURS.base);
    for (const rod of this.rods) {
      const [a, b] = this.endsOf(rod).map(flat);
      if (![...a, ...b].every(Number.isFinite)) continue;
      const shape = svg("line", { x1: a[0].toFixed(1), y1: a[1].toFixed(1), x2: b[0].toFixed(1), y2: b[1].toFixed(1), stroke: rod.colour ?? this.colourOf(rod.part), "stroke-width": Math.max(1.5, 300 * rod.radius), "stroke-linecap": rod.reach ? "butt" : "round" });
      shapes.push({ depth: (a[2] + b[2]) / 2, shape });
    }
    shapes.sort((p, q) => q.depth - p.depth);
    this.drawing.replaceChildren(
      svg("path", { d: path(this.floor), stroke: FLOOR, "stroke-width": 0.7, "stroke-opacity": 0.6, fill: "none" }),
      svg("path", { d: path(this.ghostSegments), stroke: GHOST, "stroke-width": 1, "stroke-opacity": 0.6, fill: "none", class: "ghosts" }),
      ...shapes.map(({ shape }) => shape),
    );
  }
}
