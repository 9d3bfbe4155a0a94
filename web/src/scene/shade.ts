// SPDX-License-Identifier: Apache-2.0
import { BackSide, Color, DoubleSide, EqualStencilFunc, ReplaceStencilOp, ShaderMaterial, Vector4 } from "three";

/// What all materials share: the section planes (n.x + d >= 0 is kept) and the light of the theme.
export const shared = {
  uPlanes: { value: [new Vector4(), new Vector4(), new Vector4()] },
  uSky: { value: new Color(1, 1, 1) },
  uGround: { value: new Color(0.4, 0.42, 0.46) },
};

/// What the stencil says of a pixel.
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

const kPlace = /* glsl */ `
#include <batching_pars_vertex>
varying vec3 vWorld;
#ifdef USE_BATCHING
varying vec3 vColor;
#endif
mat4 place() {
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

const kBodyVertex = /* glsl */ `
varying vec3 vNormal;
${kPlace}
void main() {
  vNormal = mat3(place()) * normal;
}`;

// Behind a section plane the first thing that a ray meets of a closed solid is its inside, and nothing else is between
// that and where the ray crossed the plane: an inside that is seen is a cut, and drawn flat and hatched. The stencil
// keeps where, so that no edges shine through the filling.
const kBodyFragment = /* glsl */ `
#ifdef BATCHED
varying vec3 vColor;
#else
uniform vec3 uColor;
#endif
uniform float uOpacity;
uniform vec4 uTint;
uniform float uHatch;
uniform vec3 uSky;
uniform vec3 uGround;
varying vec3 vNormal;
varying vec3 vWorld;
${kClip}
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
  vec3 base = vColor;
#else
  vec3 base = mix(uColor, uTint.rgb, uTint.a);
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
${kPlace}
void main() {
  place();
}`;

const kEdgeFragment = /* glsl */ `
#ifdef BATCHED
varying vec3 vColor;
#else
uniform vec3 uColor;
#endif
uniform float uOpacity;
varying vec3 vWorld;
${kClip}
void main() {
  clip(vWorld);
#ifdef BATCHED
  gl_FragColor = vec4(vColor, uOpacity);
#else
  gl_FragColor = vec4(uColor, uOpacity);
#endif
  #include <colorspace_fragment>
}`;

/// The material of a component's faces.
export function bodyMaterial(color: Color, opacity: number): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: {
      ...shared,
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

/// The material of the insides of a closed solid, seen where it is cut: shares all that `body` shows. It is not set back
/// as bodies are, so that it wins over the face of a neighbour that touches from outside.
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

/// The material of feature edges, one pixel wide.
export function edgeMaterial(color: Color, opacity: number): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { uPlanes: shared.uPlanes, uColor: { value: color }, uOpacity: { value: opacity } },
    defines: { PLANES: 0 },
    vertexShader: kEdgeVertex,
    fragmentShader: kEdgeFragment,
    transparent: opacity < 1,
    stencilFunc: EqualStencilFunc,
    stencilRef: kSurface,
  });
}

/// As bodyMaterial, for a batch of components that each have their colour.
export function batchedBodyMaterial(): ShaderMaterial {
  return batched(bodyMaterial(new Color(), 1));
}

/// As edgeMaterial, for a batch.
export function batchedEdgeMaterial(): ShaderMaterial {
  return batched(edgeMaterial(new Color(), 1));
}

function batched(material: ShaderMaterial): ShaderMaterial {
  material.defines.BATCHED = 1;
  material.extensions.multiDraw = true;
  return material;
}
