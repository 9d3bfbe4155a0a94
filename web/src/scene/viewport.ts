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
import { ArrowField } from "./arrow_field.ts";
import { AxisTriad } from "./axis_triad.ts";
import { CameraRig, kHomeDirection } from "./camera_rig.ts";
import { Ghost } from "./ghost.ts";
import { sharedUniforms } from "./materials.ts";
import type { ModelView, Pick } from "./model_view.ts";
import { kPalettes, type Palette } from "./palette.ts";
import { type StereoMode, StereoRenderer } from "./stereo.ts";
import { ViewCube } from "./view_cube.ts";

/// Options of the viewport.
export interface ViewportOptions {
  /// No animation, one image pixel a CSS pixel, and the image can be read back.
  testing: boolean;
  /// Antialiasing.
  smooth: boolean;
}

/// The 3D view: the model and its overlays. Renders on demand, only after changes.
export class Viewport {
  readonly rig = new CameraRig();
  readonly cube = new ViewCube();
  readonly triad = new AxisTriad();
  /// Arrows of contacts, of free directions, and at blocking components.
  readonly contacts: ArrowField;
  readonly directions: ArrowField;
  readonly blocked: ArrowField;
  readonly ghost: Ghost;
  readonly scene = new Scene();
  palette: Palette = kPalettes.light;
  model: ModelView | null = null;
  /// Called in each requested frame, before it is rendered if it is; returns true to request another render.
  readonly beforeRender: ((now: number) => boolean)[] = [];
  /// Called after each render.
  readonly afterRender = new Set<() => void>();
  /// Cost of the last render: draw calls, triangles, and time of the page's thread [ms].
  readonly cost = { calls: 0, triangles: 0, milliseconds: 0 };

  private readonly renderer: WebGLRenderer;
  private scheduled = false;
  /// The picture is not that of the scene.
  private stale = true;
  private planes: Plane[] = [];
  private readonly roomFromWorld = new Matrix4();
  private immersive: { room: Scene; camera: Camera; updateFrame: () => void } | null = null;
  private stereoMode: StereoMode = "off";
  private readonly stereoRenderer = new StereoRenderer();

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

  /// Maps a position on the canvas to one in the view: in side-by-side stereo, each half shows the whole view.
  positionInView(x: number, y: number): { x: number; y: number } {
    if (this.stereoMode !== "sideBySide") return { x, y };
    const half = this.rig.size.x / 2;
    return { x: 2 * (x % half), y };
  }

  /// Requests a render in the next animation frame.
  invalidate(): void {
    this.stale = true;
    this.requestFrame();
  }

  /// Requests that what precedes a render is done in the next animation frame. It is rendered only if something else asks
  /// for that.
  requestFrame(): void {
    if (this.scheduled || this.immersive) return;
    this.scheduled = true;
    requestAnimationFrame((now) => {
      this.scheduled = false;
      this.draw(now);
    });
  }

  /// True if no frame is pending.
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

  /// Shows the whole model from the default direction.
  showWhole(): void {
    if (this.model) this.rig.fit(this.model.bounds(), kHomeDirection);
  }

  /// Updates the camera's clipping range. Call after components moved or changed visibility.
  updateBounds(): void {
    const bounds = this.model?.bounds() ?? new Box3();
    if (!bounds.isEmpty()) this.rig.setSceneBounds(bounds);
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    sharedUniforms.uSky.value.set(palette.sky);
    sharedUniforms.uGround.value.set(palette.ground);
    this.contacts.color = palette.contact;
    this.directions.color = palette.free;
    this.blocked.color = palette.blocking;
    this.ghost.color = palette.ghost;
    const dark = new Color(palette.background[1]).getHSL({ h: 0, s: 0, l: 0 }).l < 0.5;
    if (dark) this.cube.setColors("#39424d", "#e8edf2", "#6d7885", palette.accent);
    else this.cube.setColors("#ffffff", "#303842", "#9aa3ad", palette.accent);
    this.triad.setColor(dark ? "#e8edf2" : "#303842");
    this.model?.setPalette(palette);
    this.invalidate();
  }

  /// The view direction of the cube under the cursor. In stereo there is no cube.
  pickCube(x: number, y: number): Vector3 | null {
    return this.stereoMode === "off" ? this.cube.pick(this.rig, x, y) : null;
  }

  /// The first visible, uncut surface point under a position on screen.
  pick(x: number, y: number): Pick | null {
    return this.castWorld(this.rig.ray(x, y));
  }

  /// The first visible, uncut surface point along a ray in the world frame.
  castWorld(ray: Ray): Pick | null {
    return this.model?.cast(ray, (pick) => this.isKept(pick.point)) ?? null;
  }

  /// Renders `room`, which contains the scene, to a headset in every frame until leaveImmersive().
  async enterImmersive(
    session: XRSession,
    room: Scene,
    camera: Camera,
    updateFrame: () => void,
  ): Promise<WebXRManager> {
    const { xr } = this.renderer;
    xr.enabled = true;
    xr.setReferenceSpaceType("local-floor");
    await xr.setSession(session);
    this.renderer.setClearColor(this.palette.background[1], 1);
    this.immersive = { room, camera, updateFrame };
    this.renderer.setAnimationLoop((now) => this.draw(now));
    return xr;
  }

  /// Returns from the headset to the page.
  leaveImmersive(): void {
    this.immersive = null;
    this.renderer.setAnimationLoop(null);
    this.renderer.xr.enabled = false;
    this.renderer.setClearColor(0, 0);
    this.setEye(null, new Matrix4());
    this.resize();
    this.invalidate();
  }

  /// @param eye of a headset, world frame; null: none. @param roomFromWorld placement of the scene in the room
  setEye(eye: Vector3 | null, roomFromWorld: Matrix4): void {
    this.rig.eye = eye;
    this.scene.updateWorldMatrix(true, false);
    this.roomFromWorld.copy(roomFromWorld);
    this.updatePlanes();
  }

  /// The current image as a PNG, with the theme's background.
  screenshot(): Promise<Blob> {
    this.stale = true;
    this.draw(performance.now());
    const copy = document.createElement("canvas");
    this.copyImage(copy);
    return new Promise((resolve) => {
      copy.toBlob((blob) => resolve(blob!), "image/png");
    });
  }

  /// Copies the image to another canvas, with the theme's background. Call directly after rendering.
  copyImage(copy: HTMLCanvasElement): void {
    if (copy.width !== this.canvas.width) copy.width = this.canvas.width;
    if (copy.height !== this.canvas.height) copy.height = this.canvas.height;
    const context = copy.getContext("2d")!;
    const gradient = context.createLinearGradient(0, 0, 0, copy.height);
    this.palette.background.forEach((color, i) => {
      gradient.addColorStop(i, color);
    });
    context.fillStyle = gradient;
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(this.canvas, 0, 0);
  }

  /// Cuts away what is behind the planes (n.x + d < 0).
  setPlanes(planes: { normal: Vector3; constant: number }[]): void {
    if (planes.length !== this.planes.length) this.model?.setPlaneCount(planes.length);
    this.planes = planes.map(({ normal, constant }) => new Plane(normal, constant));
    this.updatePlanes();
    this.invalidate();
  }

  /// Materials need the planes in the frame in which the scene is rendered.
  private updatePlanes(): void {
    this.planes.forEach((plane, i) => {
      const { normal, constant } = plane.clone().applyMatrix4(this.roomFromWorld);
      sharedUniforms.uPlanes.value[i].set(normal.x, normal.y, normal.z, constant);
    });
  }

  private isKept(point: Vector3): boolean {
    return this.planes.every((plane) => plane.distanceToPoint(point) >= 0);
  }

  private resize(): void {
    if (this.immersive) return;
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    this.renderer.setSize(clientWidth, clientHeight);
    this.rig.resize(clientWidth, clientHeight);
    this.stale = true;
    this.draw(performance.now());
  }

  private draw(now: number): void {
    const wanted = this.stale || this.rig.flying || this.immersive !== null;
    this.stale = false;
    this.rig.advance(now);
    let more = this.rig.flying;
    for (const step of this.beforeRender) more = step(now) || more;
    if (!wanted && !this.stale && !more) return;
    this.contacts.update(this.rig);
    this.directions.update(this.rig);
    this.blocked.update(this.rig);
    this.immersive?.updateFrame();
    const start = performance.now();
    this.renderer.info.reset();
    this.renderer.clear();
    if (this.immersive) {
      this.renderer.render(this.immersive.room, this.immersive.camera);
    } else if (this.stereoMode === "off") {
      this.renderer.render(this.scene, this.rig.camera);
      if (this.model) {
        this.cube.render(this.renderer, this.rig);
        this.triad.render(this.renderer, this.rig);
      }
    } else {
      const { perspective, size } = this.rig;
      this.stereoRenderer.draw(
        this.renderer,
        this.scene,
        perspective,
        this.rig.current.distance,
        this.stereoMode,
        size,
      );
    }
    const { calls, triangles } = this.renderer.info.render;
    Object.assign(this.cost, { calls, triangles, milliseconds: performance.now() - start });
    for (const step of this.afterRender) step();
    if (more) this.invalidate();
  }
}
