// How surfaces and lines are drawn: a light that travels with the viewer, one colour map, one cutting plane.
import {Color, DoubleSide, ShaderMaterial, Vector4} from 'three';
import {alarm} from './colours.js';

const vertex = `
attribute float value;
varying float vValue;
varying vec3 vNormal, vEye, vWorld;
void main() {
  vValue = value;
  vWorld = position;
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vEye = eye.xyz;
  vNormal = normalMatrix * normal;
  gl_Position = projectionMatrix * eye;
}`;

const fragment = `
uniform sampler2D map;
uniform vec4 plane;
uniform vec3 missing, alarm;
uniform float opacity;
uniform int lighting;  // 0 none, 1 by normals, 2 by flat triangles
varying float vValue;
varying vec3 vNormal, vEye, vWorld;
void main() {
  if (dot(plane.xyz, vWorld) > plane.w) discard;
  vec3 colour = vValue < -1.5 ? alarm : vValue < -0.001 ? missing : texture2D(map, vec2(clamp(vValue, 0.002, 0.998), 0.5)).rgb;
  if (lighting > 0) {
    vec3 n = normalize(lighting == 1 ? vNormal : cross(dFdx(vEye), dFdy(vEye)));
    vec3 toViewer = normalize(-vEye);
    if (dot(n, toViewer) < 0.0) n = -n;
    vec3 light = normalize(vec3(-0.35, 0.55, 1.0));
    float diffuse = max(dot(n, light), 0.0);
    float shine = pow(max(dot(n, normalize(light + toViewer)), 0.0), 60.0);
    colour *= 0.64 + 0.40 * diffuse;
    colour += 0.07 * shine;
  }
  gl_FragColor = vec4(colour, opacity);
}`;

const lineVertex = `
uniform float lift;  // length by which lines are seen through what covers them
varying vec3 vWorld;
void main() {
  vWorld = position;
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  eye.xyz *= 1.0 - min(lift / length(eye.xyz), 0.5);
  gl_Position = projectionMatrix * eye;
  gl_Position.z -= 1e-5 * gl_Position.w;
}`;

const lineFragment = `
uniform vec4 plane;
uniform vec3 colour;
uniform float opacity;
varying vec3 vWorld;
void main() {
  if (dot(plane.xyz, vWorld) > plane.w) discard;
  gl_FragColor = vec4(colour, opacity);
}`;

/** A plane that cuts nothing away. */
export const nowhere = () => new Vector4(0, 0, 0, 1);

export function faceMaterial({map, lighting, opacity = 1}) {
  return new ShaderMaterial({
    vertexShader: vertex, fragmentShader: fragment, side: DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2,
    transparent: opacity < 1,
    uniforms: {
      map: {value: map}, plane: {value: nowhere()}, missing: {value: rawColour('#d9dde3')}, alarm: {value: rawColour(alarm)},
      opacity: {value: opacity}, lighting: {value: lighting},
    },
  });
}

export function lineMaterial({colour, opacity = 1, lift = 0}) {
  return new ShaderMaterial({
    vertexShader: lineVertex, fragmentShader: lineFragment, transparent: opacity < 1,
    uniforms: {plane: {value: nowhere()}, colour: {value: rawColour(colour)}, opacity: {value: opacity}, lift: {value: lift}},
  });
}

/** As written: the shaders mix colours as they are on the screen. */
function rawColour(hex) {
  const n = parseInt(hex.slice(1), 16);
  return new Color().setRGB((n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255);
}
