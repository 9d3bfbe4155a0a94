// SPDX-License-Identifier: Apache-2.0
import {
  Box3,
  type Camera,
  Color,
  Matrix4,
  Plane,
  type Ray,
  Scene,
  type Vector3,
  WebGLRenderer,
  type WebXRManager,
} from "three";
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
  /// What the last picture cost: how many calls drew how many triangles, and how long that kept the page [ms].
  readonly cost = { calls: 0, triangles: 0, milliseconds: 0 };

  private readonly renderer: WebGLRenderer;
  private scheduled = false;
  private planes: Plane[] = [];
  private readonly roomFromWorld = new Matrix4();
  private immersion: { room: Scene; camera: Camera; everyFrame: () => void } | null = null;
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
    this.renderer.info.autoReset = false;
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
    if (this.scheduled || this.immersion) return;
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
    model?.setPlaneCount(this.planes.length);
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
    return this.castWorld(this.rig.ray(x, y));
  }

  /// What is first along a ray of the world.
  castWorld(ray: Ray): Pick | null {
    return this.model?.cast(ray, (pick) => this.isKept(pick.point)) ?? null;
  }

  /// Draws a room that holds the scene into a headset, every frame of that, until surface() is called.
  async immerse(session: XRSession, room: Scene, camera: Camera, everyFrame: () => void): Promise<WebXRManager> {
    const { xr } = this.renderer;
    xr.enabled = true;
    xr.setReferenceSpaceType("local-floor");
    await xr.setSession(session);
    this.renderer.setClearColor(this.palette.background[1], 1);
    this.immersion = { room, camera, everyFrame };
    this.renderer.setAnimationLoop((now) => this.draw(now));
    return xr;
  }

  /// Back from the headset to the page.
  surface(): void {
    this.immersion = null;
    this.renderer.setAnimationLoop(null);
    this.renderer.xr.enabled = false;
    this.renderer.setClearColor(0, 0);
    this.setEye(null, new Matrix4());
    this.resize();
    this.invalidate();
  }

  /// @param eye of a headset in the world; null: none. @param roomFromWorld where the scene stands
  setEye(eye: Vector3 | null, roomFromWorld: Matrix4): void {
    this.rig.eye = eye;
    this.scene.updateWorldMatrix(true, false);
    this.roomFromWorld.copy(roomFromWorld);
    this.placePlanes();
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
    if (planes.length !== this.planes.length) this.model?.setPlaneCount(planes.length);
    this.planes = planes.map(({ normal, constant }) => new Plane(normal, constant));
    this.placePlanes();
    this.invalidate();
  }

  /// The materials want them where the scene is drawn.
  private placePlanes(): void {
    this.planes.forEach((plane, i) => {
      const { normal, constant } = plane.clone().applyMatrix4(this.roomFromWorld);
      shared.uPlanes.value[i].set(normal.x, normal.y, normal.z, constant);
    });
  }

  private isKept(point: Vector3): boolean {
    return this.planes.every((plane) => plane.distanceToPoint(point) >= 0);
  }

  private resize(): void {
    if (this.immersion) return;
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
    this.immersion?.everyFrame();
    const start = performance.now();
    this.renderer.info.reset();
    this.renderer.clear();
    if (this.immersion) {
      this.renderer.render(this.immersion.room, this.immersion.camera);
    } else if (this.stereoMode === "off") {
      this.renderer.render(this.scene, this.rig.camera);
      if (this.model) this.cube.render(this.renderer, this.rig);
    } else {
      const { perspective, size } = this.rig;
      this.stereoPicture.draw(this.renderer, this.scene, perspective, this.rig.current.distance, this.stereoMode, size);
    }
    const { calls, triangles } = this.renderer.info.render;
    Object.assign(this.cost, { calls, triangles, milliseconds: performance.now() - start });
    for (const step of this.afterPicture) step();
    if (more) this.invalidate();
  }
}
