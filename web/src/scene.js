// What is drawn: surface, edges, linear mesh, cut, the picked element; and the camera.
import {BufferAttribute, BufferGeometry, ColorManagement, DataTexture, LineSegments, LinearFilter, LinearSRGBColorSpace, Mesh,
  NearestFilter, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {faceMaterial, lineMaterial, nowhere} from './shaders.js';

ColorManagement.enabled = false;
const background = 0xf7f8fa;
const fieldOfView = 30;

export const directions = {
  iso: [0.62, -0.68, 0.4], x: [1, 0, 0], '-x': [-1, 0, 0], y: [0, 1, 0], '-y': [0, -1, 0], z: [0, 0, 1], '-z': [0, 0, -1],
};

function geometryOf(position, extra = {}) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', position instanceof BufferAttribute ? position : new BufferAttribute(position, 3));
  for (const [name, attribute] of Object.entries(extra)) geometry.setAttribute(name, attribute);
  return geometry;
}

export class Stage {
  constructor(canvas, {arrays}) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: true});
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setClearColor(background);
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(fieldOfView, 1, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => { this.schedule(); this.onMove?.(); });
    this.map = new DataTexture(new Uint8Array(4 * 256), 256, 1);
    this.position = new BufferAttribute(arrays.point, 3);
    this.normal = new BufferAttribute(arrays.normal, 3, true);
    this.value = new BufferAttribute(new Float32Array(arrays.point.length / 3), 1);
    this.addObjects();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  addObjects() {
    const shared = {normal: this.normal, value: this.value};
    const add = (object, order) => {
      object.frustumCulled = false;
      object.renderOrder = order;
      this.scene.add(object);
      return object;
    };
    const faces = (geometry, options) => add(new Mesh(geometry, faceMaterial({map: this.map, ...options})), 0);
    const lines = (geometry, options) => add(new LineSegments(geometry, lineMaterial(options)), 1);
    const empty = () => geometryOf(new Float32Array(0));
    this.surface = faces(geometryOf(this.position, shared), {lighting: 1});
    this.edges = lines(geometryOf(this.position), {colour: '#1c2733', opacity: 0.75});
    this.linearSurface = faces(empty(), {lighting: 2});
    this.linearEdges = lines(geometryOf(this.position), {colour: '#c2185b', opacity: 0.9});
    this.slice = faces(empty(), {lighting: 0});
    this.sliceEdges = lines(empty(), {colour: '#1c2733', opacity: 0.55});
    this.pickFaces = faces(empty(), {lighting: 0, opacity: 0.35});
    this.pickFaces.material.uniforms.missing.value.setRGB(1, 0.1, 0.5);
    this.pickLines = lines(empty(), {colour: '#e0006c'});
    for (const [object, order] of [[this.pickFaces, 5], [this.pickLines, 6]]) {
      object.renderOrder = order;
      object.material.depthTest = false;
    }
  }

  setMap(texels, isStepped) {
    this.map.image.data = texels;
    this.map.magFilter = this.map.minFilter = isStepped ? NearestFilter : LinearFilter;
    this.map.needsUpdate = true;
  }

  setIndex(object, index) {
    object.geometry.setIndex(new BufferAttribute(index, 1));
  }

  setSlice(cut, values) {
    this.replace(this.slice, cut.triangles, {value: new BufferAttribute(values, 1)});
    this.replace(this.sliceEdges, cut.lines);
  }

  replace(object, positions, extra) {
    object.geometry.dispose();
    object.geometry = geometryOf(positions, extra);
  }

  setLinear(triangles, values) {
    this.replace(this.linearSurface, triangles, {value: new BufferAttribute(values, 1)});
  }

  setPlane(plane) {
    const {surface, edges, linearSurface, linearEdges} = this;
    for (const object of [surface, edges, linearSurface, linearEdges]) {
      const value = object.material.uniforms.plane.value;
      if (plane) value.set(...plane.n, plane.d);
      else value.copy(nowhere());
    }
  }

  setPick(skin) {
    const none = new Float32Array(0);
    const triangles = skin?.triangles ?? none;
    this.replace(this.pickFaces, triangles, {value: new BufferAttribute(new Float32Array(triangles.length / 3).fill(-1), 1)});
    this.replace(this.pickLines, skin?.lines ?? none);
  }

  /** Everything drawn lies in this ball: near and far planes follow it. */
  setBall(centre, radius) {
    this.ball = {centre: new Vector3(...centre), radius};
  }

  lookAt(target, direction, distance) {
    this.controls.target.set(...target);
    this.camera.position.copy(new Vector3(...direction).normalize().multiplyScalar(distance)).add(this.controls.target);
    // Straight down the axis the camera would not know its way up.
    if (Math.hypot(this.camera.position.x - target[0], this.camera.position.y - target[1]) < 1e-6 * distance) this.camera.position.y -= 1e-4 * distance;
    this.controls.update();
    this.schedule();
  }

  /** From `direction`, as near as all corners of the box are still seen. */
  fit(low, high, direction) {
    const centre = low.map((l, d) => (l + high[d]) / 2);
    const back = new Vector3(...direction).normalize();
    const right = new Vector3(0, 0, 1).cross(back);
    if (right.length() < 1e-6) right.set(1, 0, 0);
    right.normalize();
    const up = back.clone().cross(right);
    const tangent = Math.tan((fieldOfView * Math.PI) / 360) * 0.86;
    let distance = 0;
    for (let k = 0; k < 8; ++k) {
      const corner = new Vector3(...low.map((l, d) => (k & (1 << d) ? high[d] : l) - centre[d]));
      const across = Math.max(Math.abs(corner.dot(up)), Math.abs(corner.dot(right)) / this.camera.aspect);
      distance = Math.max(distance, corner.dot(back) + across / tangent);
    }
    this.lookAt(centre, direction, distance);
  }

  eye() {
    return this.camera.position.clone().sub(this.controls.target);
  }

  ray(clientX, clientY) {
    const box = this.canvas.getBoundingClientRect();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2), this.camera);
    return caster.ray;
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas.parentElement;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.onResize?.();
    this.draw();
  }

  schedule() {
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.isScheduled = false;
    if (!this.ball) return;
    const toTarget = this.eye().length();
    const toCentre = this.camera.position.distanceTo(this.ball.centre);
    this.camera.near = Math.max(toCentre - this.ball.radius, 0.01 * toTarget);
    this.camera.far = Math.max(toCentre + this.ball.radius, 1.1 * this.camera.near);
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }
}
