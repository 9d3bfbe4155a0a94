// SPDX-License-Identifier: Apache-2.0
import { BackSide, Color, DoubleSide, EqualStencilFunc, ReplaceStencilOp, ShaderMaterial, Vector4 } from "three";

/// Uniforms of all materials: the section planes (n.x + d >= 0 is kept) and the theme's ambient light.
export const sharedUniforms = {
  uPlanes: { value: [new Vector4(), new Vector4(), new Vector4()] },
  uSky: { value: new Color(1, 1, 1) },
  uGround: { value: new Color(0.4, 0.42, 0.46) },
};

/// Stencil values of a pixel.
const kSurface = 0;
const kCut = 1;

const kClip = /* glsl */ `
#if PLANES > 0
uniform vec4 uPlanes[3];
void clip(vec3 world) {
  for (int i = 0; i < PLANES; ++i)
    if (dot(uPlanes[i].xyz, world) + uPlanes[i].w < 0.0) discard;
}
#else
void clip(vec3 world) {}
#endif
`;

const kTransform = /* glsl */ `
#include <batching_pars_vertex>
varying vec3 vWorld;
#ifdef USE_BATCHING
varying vec3 vColor;
#endif
mat4 transform() {
#ifdef USE_BATCHING
  float instance = getIndirectIndex(gl_DrawID);
  mat4 worldFromMesh = modelMatrix * getBatchingMatrix(instance);
  vColor = getBatchingColor(instance).rgb;
#else
  mat4 worldFromMesh = modelMatrix;
#endif
  vec4 world = worldFromMesh * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
  return worldFromMesh;
}`;

/// Inputs of both fragment shaders: position, opacity and the component's colour.
const kFragmentInputs = /* glsl */ `
#ifdef BATCHED
varying vec3 vColor;
vec3 ownColor() { return vColor; }
#else
uniform vec3 uColor;
vec3 ownColor() { return uColor; }
#endif
uniform float uOpacity;
varying vec3 vWorld;
${kClip}`;

const kBodyVertex = /* glsl */ `
varying vec3 vNormal;
${kTransform}
void main() {
  vNormal = mat3(transform()) * normal;
}`;

// Section caps: behind a section plane, the first surface that a ray meets of a closed solid is its inside, with
// nothing between it and the plane. So a visible inside is drawn as the cut face, flat and hatched. The stencil marks
// these pixels, so that no edges show through the cap.
const kBodyFragment = /* glsl */ `
${kFragmentInputs}
uniform vec4 uTint;
uniform float uHatch;
uniform vec3 uSky;
uniform vec3 uGround;
varying vec3 vNormal;
vec3 lit(vec3 base, vec3 normal, vec3 toEye) {
  vec3 right = vec3(viewMatrix[0][0], viewMatrix[1][0], viewMatrix[2][0]);
  vec3 up = vec3(viewMatrix[0][1], viewMatrix[1][1], viewMatrix[2][1]);
  vec3 key = normalize(toEye + 0.55 * up - 0.45 * right);
  vec3 fill = normalize(toEye + 0.9 * right - 0.2 * up);
  vec3 ambient = mix(uGround, uSky, 0.5 + 0.5 * normal.z);
  float diffuse = 0.55 * max(dot(normal, key), 0.0) + 0.18 * max(dot(normal, fill), 0.0);
  float shine = pow(max(dot(normal, normalize(key + toEye)), 0.0), 40.0);
  return base * (0.42 * ambient + diffuse) + vec3(0.09 * shine);
}
void main() {
  clip(vWorld);
#ifdef BATCHED
  vec3 base = ownColor();
#else
  vec3 base = mix(ownColor(), uTint.rgb, uTint.a);
#endif
  vec3 toEye = isOrthographic ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2])
                              : normalize(cameraPosition - vWorld);
  vec3 normal = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 shown = lit(base, normal, toEye);
#ifdef CUT
  float last = -1e30;
  vec3 facing = normal;
  for (int i = 0; i < PLANES; ++i) {
    float into = -dot(uPlanes[i].xyz, toEye);
    float at = -(dot(uPlanes[i].xyz, vWorld) + uPlanes[i].w) / into;
    if (into > 1e-6 && at > last) { last = at; facing = -uPlanes[i].xyz; }
  }
  vec3 back = vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]);
  bool line = mod(gl_FragCoord.x + uHatch * gl_FragCoord.y, 9.0) < 1.3;
  shown = lit(base, facing, back) * (line ? 0.62 : 0.95);
#endif
  gl_FragColor = vec4(shown, uOpacity);
  #include <colorspace_fragment>
}`;

const kEdgeVertex = /* glsl */ `
${kTransform}
void main() {
  transform();
}`;

const kEdgeFragment = /* glsl */ `
${kFragmentInputs}
void main() {
  clip(vWorld);
  gl_FragColor = vec4(ownColor(), uOpacity);
  #include <colorspace_fragment>
}`;

/// Material of a component's faces.
export function bodyMaterial(color: Color, opacity: number): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: {
      ...sharedUniforms,
      uColor: { value: color },
      uOpacity: { value: opacity },
      uTint: { value: new Vector4(0, 0, 0, 0) },
      uHatch: { value: 1 },
    },
    defines: { PLANES: 0 },
    vertexShader: kBodyVertex,
    fragmentShader: kBodyFragment,
    side: DoubleSide,
    transparent: opacity < 1,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    stencilZPass: ReplaceStencilOp,
    stencilRef: kSurface,
  });
}

/// Material of the section caps of a closed solid; shares the uniforms of `body`. It has no polygon offset, so it wins
/// over the face of a touching neighbour.
export function cutMaterial(body: ShaderMaterial, hatch: number): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { ...body.uniforms, uHatch: { value: hatch } },
    defines: { PLANES: 0, CUT: 1 },
    vertexShader: kBodyVertex,
    fragmentShader: kBodyFragment,
    side: BackSide,
    stencilWrite: true,
    stencilZPass: ReplaceStencilOp,
    stencilRef: kCut,
  });
}

/// Material of feature edges, one pixel wide.
export function edgeMaterial(color: Color, opacity: number): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { uPlanes: sharedUniforms.uPlanes, uColor: { value: color }, uOpacity: { value: opacity } },
    defines: { PLANES: 0 },
    vertexShader: kEdgeVertex,
    fragmentShader: kEdgeFragment,
    transparent: opacity < 1,
    stencilFunc: EqualStencilFunc,
    stencilRef: kSurface,
  });
}

/// bodyMaterial for a batch in which each component has its own colour.
export function batchedBodyMaterial(): ShaderMaterial {
  return batched(bodyMaterial(new Color(), 1));
}

/// edgeMaterial for a batch.
export function batchedEdgeMaterial(): ShaderMaterial {
  return batched(edgeMaterial(new Color(), 1));
}

function batched(material: ShaderMaterial): ShaderMaterial {
  material.defines.BATCHED = 1;
  material.extensions.multiDraw = true;
  return material;
}
