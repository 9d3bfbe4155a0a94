// SPDX-License-Identifier: Apache-2.0
import { Box3, Color, Scene, type Vector3, WebGLRenderer } from "three";
import { CameraRig } from "./camera_rig.ts";
import { ArrowField, Ghost } from "./marks.ts";
import type { ModelView, Pick } from "./model_view.ts";
import { kPalettes, type Palette } from "./palette.ts";
import { shared } from "./shade.ts";
import { type StereoMode, StereoPicture } from "./stereo.ts";
import { ViewCube } from "./view_cube.ts";

export interface ViewportOptions {
  /// Views change at once, a pixel of the picture is one of the page, and pictures can be read back.
  testing: boolean;
  /// Smooth edges.
  smooth: boolean;
}

/// The picture: the model, what is drawn over it, and when it is drawn (only where something changed).
export class Viewport {
  readonly rig = new CameraRig();
  readonly cube = new ViewCube();
  readonly contacts: ArrowField;
  readonly directions: ArrowField;
  readonly blocked: ArrowField;
  readonly ghost: Ghost;
  readonly scene = new Scene();
  palette: Palette = kPalettes.light;
  model: ModelView | null = null;
  /// Called before each picture; returns whether another one is to follow.
  readonly beforePicture: ((now: number) => boolean)[] = [];
  readonly afterPicture = new Set<() => void>();

  private readonly renderer: WebGLRenderer;
  private scheduled = false;
  private planeCount = 0;
  private stereoMode: StereoMode = "off";
  private readonly stereoPicture = new StereoPicture();

  constructor(
    readonly canvas: HTMLCanvasElement,
    { testing, smooth }: ViewportOptions,
  ) {
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: smooth,
      alpha: true,
      stencil: true,
      preserveDrawingBuffer: testing,
    });
    this.renderer.autoClear = false;
    this.renderer.setPixelRatio(testing ? 1 : Math.min(devicePixelRatio, 2));
    this.rig.instant = testing || matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.rig.onChange = () => this.invalidate();
    this.contacts = new ArrowField(this.palette.contact, 64);
    this.directions = new ArrowField(this.palette.free, 32);
    this.blocked = new ArrowField(this.palette.blocking, 32);
    this.ghost = new Ghost(this.palette.ghost);
    this.scene.add(this.contacts.object, this.directions.object, this.blocked.object, this.ghost.object);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
  }

  get stereo(): StereoMode {
    return this.stereoMode;
  }

  set stereo(mode: StereoMode) {
    this.stereoMode = mode;
    this.invalidate();
  }

  /// The place in the whole view that a place on the canvas shows: side by side, each half is all of it.
  placeInView(x: number, y: number): { x: number; y: number } {
    if (this.stereoMode !== "sideBySide") return { x, y };
    const half = this.rig.size.x / 2;
    return { x: 2 * (x % half), y };
  }

  /// Asks for a picture at the next frame of the screen.
  invalidate(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame((now) => {
      this.scheduled = false;
      this.draw(now);
    });
  }

  /// Whether the picture shows everything asked for.
  get settled(): boolean {
    return !this.scheduled;
  }

  setModel(model: ModelView | null): void {
    if (this.model) {
      this.scene.remove(this.model.root);
      this.model.dispose();
    }
    this.model = model;
    model?.setPlaneCount(this.planeCount);
    if (model) this.scene.add(model.root);
    this.updateBounds();
    this.invalidate();
  }

  /// Call where components were moved or shown.
  updateBounds(): void {
    const bounds = this.model?.bounds() ?? new Box3();
    if (!bounds.isEmpty()) this.rig.setSceneBounds(bounds);
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    shared.uSky.value.set(palette.sky);
    shared.uGround.value.set(palette.ground);
    this.contacts.color = palette.contact;
    this.directions.color = palette.free;
    this.blocked.color = palette.blocking;
    this.ghost.color = palette.ghost;
    const dark = new Color(palette.background[1]).getHSL({ h: 0, s: 0, l: 0 }).l < 0.5;
    if (dark) this.cube.setColors("#39424d", "#e8edf2", "#6d7885", palette.accent);
    else this.cube.setColors("#ffffff", "#303842", "#9aa3ad", palette.accent);
    this.model?.setPalette(palette);
    this.invalidate();
  }

  /// The view that a place on the cube stands for; two eyes have no cube.
  pickCube(x: number, y: number): Vector3 | null {
    return this.stereoMode === "off" ? this.cube.pick(this.rig, x, y) : null;
  }

  pick(x: number, y: number): Pick | null {
    return this.model?.cast(this.rig.ray(x, y), (pick) => this.isKept(pick.point)) ?? null;
  }

  /// The picture as a PNG, with the background of the theme.
  screenshot(): Promise<Blob> {
    this.draw(performance.now());
    const copy = document.createElement("canvas");
    this.copyPicture(copy);
    return new Promise((resolve) => {
      copy.toBlob((blob) => resolve(blob!), "image/png");
    });
  }

  /// Puts what was just drawn onto another canvas, with the background of the theme. Only right after it was drawn.
  copyPicture(copy: HTMLCanvasElement): void {
    if (copy.width !== this.canvas.width) copy.width = this.canvas.width;
    if (copy.height !== this.canvas.height) copy.height = this.canvas.height;
    const brush = copy.getContext("2d")!;
    const shade = brush.createLinearGradient(0, 0, 0, copy.height);
    this.palette.background.forEach((color, i) => {
      shade.addColorStop(i, color);
    });
    brush.fillStyle = shade;
    brush.fillRect(0, 0, copy.width, copy.height);
    brush.drawImage(this.canvas, 0, 0);
  }

  /// Cuts away what is behind the planes (n.x + d < 0).
  setPlanes(planes: { normal: Vector3; constant: number }[]): void {
    planes.forEach(({ normal, constant }, i) => {
      shared.uPlanes.value[i].set(normal.x, normal.y, normal.z, constant);
    });
    if (planes.length !== this.planeCount) this.model?.setPlaneCount(planes.length);
    this.planeCount = planes.length;
    this.invalidate();
  }

  private isKept(point: Vector3): boolean {
    const planes = shared.uPlanes.value.slice(0, this.planeCount);
    return planes.every((plane) => plane.x * point.x + plane.y * point.y + plane.z * point.z + plane.w >= 0);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    this.renderer.setSize(clientWidth, clientHeight);
    this.rig.resize(clientWidth, clientHeight);
    this.draw(performance.now());
  }

  private draw(now: number): void {
    this.rig.advance(now);
    let more = this.rig.flying;
    for (const step of this.beforePicture) more = step(now) || more;
    this.contacts.update(this.rig);
    this.directions.update(this.rig);
    this.blocked.update(this.rig);
    this.renderer.clear();
    if (this.stereoMode === "off") {
      this.renderer.render(this.scene, this.rig.camera);
      if (this.model) this.cube.render(this.renderer, this.rig);
    } else {
      const { perspective, size } = this.rig;
      this.stereoPicture.draw(this.renderer, this.scene, perspective, this.rig.current.distance, this.stereoMode, size);
    }
    for (const step of this.afterPicture) step();
    if (more) this.invalidate();
  }
}
