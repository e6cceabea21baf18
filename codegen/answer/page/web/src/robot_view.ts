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
  GridHelper,
  Group,
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
import { distance, Drawable, extentOf, scaleColour, Vector } from "./robot";

const COLOURS = { base: "#8a8f98", platform: "#e08a2e", link: "#5f7fb8", rail: "#9aa0a6", joint: "#3d4450" };
const DEPENDENT = "#c2185b";

/** What the colours of the legs mean. */
export interface LegScale {
  readonly label: string;
  readonly unit: string | undefined;
  readonly lo: number;
  readonly hi: number;
  /** By row of the matrix; without it the colour is that of the shown length. */
  readonly byRow?: ReadonlyMap<number, number>;
}

const isRod = (part: DrawnPart): boolean => part.kind !== "base" && part.kind !== "platform";

export class RobotView {
  readonly element: HTMLElement;
  /** Rows of the matrix whose parts are marked as dependent. */
  marked: ReadonlySet<number> = new Set();
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 4 / 3, 0.01, 100);
  private readonly rods: { part: DrawnPart; mesh: Mesh }[] = [];
  private readonly plates: { part: DrawnPart; mesh: Mesh; rim: Mesh[] }[] = [];
  private readonly knots: { point: number; mesh: Mesh }[] = [];
  private readonly drawing: SVGSVGElement;
  private renderer: WebGLRenderer | null = null;
  private controls: OrbitControls | null = null;
  private points: Vector[] = [];
  private scale: LegScale;
  private readonly unit: number; // radius of the robot
  private readonly center: Vector;

  constructor(private readonly robot: Drawable, name: string, unit: string | undefined) {
    const { center, radius, isPlanar } = extentOf(robot);
    [this.center, this.unit] = [center, radius];
    this.scale = { label: "length of a leg", unit, ...this.rangeOfLengths() };
    this.drawing = svg("svg", { viewBox: "0 0 800 600", class: "robot-drawing", role: "img", "aria-label": `Drawing of ${name}` });
    const canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": `${name} in three dimensions; arrow keys turn the view, plus and minus zoom` });
    this.element = h("div", { class: "robot-view" }, canvas, this.drawing);
    this.build();
    // From above for a robot in the plane.
    this.camera.position.set(...((isPlanar ? [0, -0.9, 3.2] : [1.9, -2.6, 1.5]) as [number, number, number]));
    this.camera.up.set(0, 0, 1);
    this.camera.lookAt(0, 0, 0);
    this.camera.updateMatrixWorld();
    this.start(canvas);
  }

  /** Draws these points; `parameters` only matter for the shown lengths. */
  show(points: Vector[]): void {
    this.points = points;
    for (const { part, mesh } of this.rods) this.placeRod(mesh, part);
    for (const { part, mesh, rim } of this.plates) this.placePlate(part, mesh, rim);
    for (const { point, mesh } of this.knots) mesh.position.copy(this.local(points[point]));
    this.render();
  }

  colourOf(part: DrawnPart): string {
    if (part.row >= 0 && this.marked.has(part.row)) return DEPENDENT;
    if (part.kind !== "leg") return COLOURS[part.kind];
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

  /** Coordinates in which the robot has radius 1 about the origin. */
  private local(point: Vector): Vector3 {
    return new Vector3(...point.map((x, axis) => (Number.isFinite(x) ? (x - this.center[axis]) / this.unit : 1e6)) as [number, number, number]);
  }

  private build(): void {
    const mesh = (geometry: BufferGeometry, colour: string): Mesh => {
      const made = new Mesh(geometry, new MeshStandardMaterial({ color: colour, roughness: 0.55 }));
      this.scene.add(made);
      return made;
    };
    const used = new Set<number>();
    for (const part of this.robot.parts) {
      if (isRod(part)) {
        const thick = part.kind === "joint" ? 0.035 : part.kind === "rail" ? 0.008 : 0.016;
        for (let i = 0; i + 1 < part.points.length; ++i)
          this.rods.push({
            part: { ...part, points: part.points.slice(i, i + 2) },
            mesh: mesh(new CylinderGeometry(thick, thick, 1, 20), "#888"),
          });
        if (part.kind !== "joint") part.points.forEach((i) => used.add(i));
      } else {
        const rim = part.points.map(() => mesh(new CylinderGeometry(0.012, 0.012, 1, 12), COLOURS[part.kind as "base"]));
        const plate = mesh(new BufferGeometry(), COLOURS[part.kind as "base"]);
        Object.assign(plate.material, { side: DoubleSide, transparent: true, opacity: 0.35, depthWrite: false });
        this.plates.push({ part, mesh: plate, rim });
      }
    }
    for (const point of used) this.knots.push({ point, mesh: mesh(new SphereGeometry(0.026, 20, 14), COLOURS.joint) });
    this.scene.add(new AmbientLight(new Color("#ffffff"), 1.6));
    const sun = new DirectionalLight(new Color("#ffffff"), 2.2);
    sun.position.set(2, -3, 4);
    this.scene.add(sun);
    const floor = new Group();
    const grid = new GridHelper(2.4, 12, "#9aa0a6", "#c4c8cc");
    Object.assign(grid.material, { transparent: true, opacity: 0.35 });
    grid.rotation.x = Math.PI / 2;
    floor.add(grid);
    floor.position.z = -1;
    this.scene.add(floor);
  }

  private placeRod(mesh: Mesh, part: DrawnPart): void {
    let a = this.local(this.points[part.points[0]]);
    let b = this.local(this.points[part.points[1]]);
    if (part.kind === "joint") {
      // Its second point is one unit of length along the axis.
      const axis = b.sub(a).normalize().multiplyScalar(0.06);
      b = a.clone().add(axis);
      a = a.clone().sub(axis);
    }
    this.stretch(mesh, a, b);
    (mesh.material as MeshStandardMaterial).color.set(this.colourOf(part));
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
    const triangles: number[] = [];
    for (let i = 1; i + 1 < corners.length; ++i)
      for (const corner of [corners[0], corners[i], corners[i + 1]]) triangles.push(corner.x, corner.y, corner.z);
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
    const flat = (point: Vector3): [number, number, number] => {
      const p = point.project(this.camera);
      return [400 + 400 * p.x, 300 - 300 * p.y, p.z];
    };
    const shapes: { depth: number; shape: SVGElement }[] = [];
    for (const { part } of this.plates) {
      const corners = part.points.map((i) => flat(this.local(this.points[i])));
      const colour = COLOURS[part.kind as "base"];
      const shape = svg("polygon", { points: corners.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" "), fill: colour, "fill-opacity": 0.35, stroke: colour, "stroke-width": 4 });
      shapes.push({ depth: Math.max(...corners.map((c) => c[2])), shape });
    }
    for (const { part } of this.rods) {
      if (part.kind === "joint") continue;
      const [a, b] = part.points.map((i) => flat(this.local(this.points[i])));
      if (![...a, ...b].every(Number.isFinite)) continue;
      const shape = svg("line", { x1: a[0].toFixed(1), y1: a[1].toFixed(1), x2: b[0].toFixed(1), y2: b[1].toFixed(1), stroke: this.colourOf(part), "stroke-width": 6, "stroke-linecap": "round" });
      shapes.push({ depth: (a[2] + b[2]) / 2, shape });
    }
    shapes.sort((p, q) => q.depth - p.depth);
    this.drawing.replaceChildren(...shapes.map(({ shape }) => shape));
  }
}
