// SPDX-License-Identifier: Apache-2.0
import {
  Color,
  Group,
  InstancedMesh,
  LatheGeometry,
  Matrix4,
  MeshBasicMaterial,
  NormalBlending,
  Quaternion,
  ShaderMaterial,
  Vector2,
  Vector3,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { CameraRig } from "./camera_rig.ts";
import type { ComponentView } from "./model_view.ts";

/// An arrow to be drawn at a constant size on screen.
export interface Arrow {
  point: Vector3;
  direction: Vector3;
  /// [px]
  length: number;
}

const kUpAxis = new Vector3(0, 1, 0);

/// Arrows with a ball at their foot, seen through everything.
export class ArrowField {
  readonly object: InstancedMesh;
  arrows: Arrow[] = [];

  constructor(
    color: string,
    private readonly capacity: number,
  ) {
    const material = new MeshBasicMaterial({ color, depthTest: false, transparent: true });
    this.object = new InstancedMesh(arrowShape(), material, capacity);
    this.object.count = 0;
    this.object.frustumCulled = false;
    this.object.renderOrder = 10;
  }

  set color(color: string) {
    (this.object.material as MeshBasicMaterial).color.set(color);
  }

  /// Sizes the arrows for the camera; call before each picture.
  update(rig: CameraRig): void {
    if (this.arrows.length === 0 && this.object.count === 0) return;
    const matrix = new Matrix4();
    const shown = this.arrows.slice(0, this.capacity);
    shown.forEach((arrow, i) => {
      const scale = rig.pixelSize(arrow.point) * arrow.length;
      const turn = new Quaternion().setFromUnitVectors(kUpAxis, arrow.direction.clone().normalize());
      this.object.setMatrixAt(i, matrix.compose(arrow.point, turn, new Vector3(scale, scale, scale)));
    });
    this.object.count = shown.length;
    this.object.instanceMatrix.needsUpdate = true;
  }

  /// The arrow nearest to a place on screen, within a finger's breadth, or -1.
  pick(rig: CameraRig, x: number, y: number): number {
    let [best, least] = [-1, 12];
    this.arrows.forEach((arrow, i) => {
      const tip = arrow.point.clone().addScaledVector(arrow.direction, rig.pixelSize(arrow.point) * arrow.length);
      const distance = distanceToSegment(new Vector2(x, y), rig.project(arrow.point), rig.project(tip));
      if (distance < least) [best, least] = [i, distance];
    });
    return best;
  }
}

/// A ball, a shaft and a tip, one long, along +y.
function arrowShape(): LatheGeometry {
  const ball = Array.from({ length: 7 }, (_, i) => {
    const angle = -Math.PI / 2 + (i / 6) * 2.6;
    return new Vector2(0.13 * Math.cos(angle), 0.13 * Math.sin(angle));
  });
  const rest = [new Vector2(0.035, 0.15), new Vector2(0.035, 0.68), new Vector2(0.12, 0.68), new Vector2(0, 1)];
  return new LatheGeometry([...ball, ...rest], 14);
}

/// How far a place on screen is from a segment [px].
export function distanceToSegment(place: Vector2, a: Vector3, b: Vector3): number {
  const [from, along] = [new Vector2(a.x, a.y), new Vector2(b.x - a.x, b.y - a.y)];
  const part = along.lengthSq() === 0 ? 0 : place.clone().sub(from).dot(along) / along.lengthSq();
  return from.addScaledVector(along, Math.min(1, Math.max(0, part))).distanceTo(place);
}

/// Where the hand wants the components to be: see-through copies, and a band from the grabbed point to where it should be.
export class Ghost {
  readonly object = new Group();
  private readonly material: ShaderMaterial;
  /// From the grabbed point to where the hand wants it.
  readonly band: LineSegments2;
  private bodies: { body: Group; component: ComponentView }[] = [];

  constructor(color: string) {
    this.material = ghostMaterial(color);
    const line = new LineMaterial({ color, linewidth: 2, dashed: true, depthTest: false, transparent: true });
    this.band = new LineSegments2(new LineSegmentsGeometry(), line);
    this.band.frustumCulled = false;
    this.band.renderOrder = 9;
    this.object.visible = false;
  }

  set color(color: string) {
    this.material.uniforms.uColor.value.set(color);
    this.band.material.color.set(color);
  }

  show(components: ComponentView[]): void {
    this.object.clear();
    this.bodies = components.map((component) => ({ body: component.copyOfBody(this.material), component }));
    this.object.add(this.band, ...this.bodies.map(({ body }) => body));
    this.object.visible = false;
  }

  /// @param worldFromAssembled where the components should be; `from`, `to`: the ends of the band
  place(worldFromAssembled: Matrix4, band: { from: Vector3; to: Vector3 } | null, pixel: number): void {
    for (const { body, component } of this.bodies) {
      body.matrix.multiplyMatrices(worldFromAssembled, component.raw.assembledFromMesh);
      body.matrixWorldNeedsUpdate = true;
    }
    this.band.visible = band !== null;
    if (band) {
      this.band.geometry.setPositions([...band.from.toArray(), ...band.to.toArray()]);
      this.band.computeLineDistances();
      this.band.material.dashSize = 7 * pixel;
      this.band.material.gapSize = 5 * pixel;
    }
    this.object.visible = true;
  }

  hide(): void {
    this.object.visible = false;
  }

  clear(): void {
    this.object.clear();
    this.bodies = [];
    this.object.visible = false;
  }
}

/// Bright at the silhouette, nearly clear inside.
function ghostMaterial(color: string): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { uColor: { value: new Color(color) } },
    vertexShader: /* glsl */ `
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vView = view.xyz;
  vNormal = normalMatrix * normal;
  gl_Position = projectionMatrix * view;
}`,
    fragmentShader: /* glsl */ `
uniform vec3 uColor;
varying vec3 vNormal;
varying vec3 vView;
void main() {
  vec3 toEye = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(-vView);
  float rim = 1.0 - abs(dot(normalize(vNormal), toEye));
  gl_FragColor = vec4(uColor, 0.16 + 0.5 * rim * rim);
  #include <colorspace_fragment>
}`,
    transparent: true,
    depthWrite: false,
    blending: NormalBlending,
  });
}
