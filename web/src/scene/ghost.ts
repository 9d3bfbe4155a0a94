// SPDX-License-Identifier: Apache-2.0
import { Color, Group, type Matrix4, NormalBlending, ShaderMaterial, type Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { ComponentView } from "./model_view.ts";

/// The ghost of the target: translucent copies of the components, and a band from the grabbed point to its target.
export class Ghost {
  readonly object = new Group();
  private readonly material: ShaderMaterial;
  /// The band from the grabbed point to its target.
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

  /// Prepares copies of components; they stay hidden until `place`.
  show(components: ComponentView[]): void {
    this.object.clear();
    this.bodies = components.map((component) => ({ body: component.copyOfBody(this.material), component }));
    this.object.add(this.band, ...this.bodies.map(({ body }) => body));
    this.object.visible = false;
  }

  /// @param worldFromAssembled the target; @param band its ends, world frame; @param pixel size of a pixel at the band
  /// [mm]
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

  /// Hides the ghost until the next `place`.
  hide(): void {
    this.object.visible = false;
  }

  /// Removes the copies.
  clear(): void {
    this.object.clear();
    this.bodies = [];
    this.object.visible = false;
  }
}

/// Bright at the silhouette, nearly transparent inside.
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
