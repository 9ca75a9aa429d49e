// The 3-D view: truth and estimate coloured by the distance between them, at every step.
import { AmbientLight, DirectionalLight, PerspectiveCamera, Plane, Raycaster, Scene, Spherical, Vector2, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { element } from './dom.js';
import { Organs } from './organs.js';
import { Surroundings } from './surroundings.js';
import { ViewerPanel } from './viewer_panel.js';

const directions = { oblique: [0.72, -0.85, 0.42], left: [1, 0, 0], front: [0, -1, 0.0001], above: [0, -0.0001, 1] };

function hasWebGL() {
  try {
    return document.createElement('canvas').getContext('webgl2') !== null;
  } catch {
    return false;
  }
}

class Viewer {
  constructor(host, data) {
    this.host = host;
    this.data = data;
    this.conditions = data.model.conditions.filter((condition) => condition.nominal !== null);
    this.state = {
      step: data.model.steps, condition: (this.conditions.find(({ name }) => name === 'full') ?? this.conditions.at(-1)).name,
      shown: 'truth', byOrgan: false, scale: 4, cut: false, hidden: new Set(),
      plane: true, controlPoints: true, attachments: false, bars: false,
    };
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.localClippingEnabled = true;
    this.renderer.setClearColor('#ffffff');
    this.clipping = [];
    this.scene = new Scene();
    this.organs = new Organs(data, this.clipping);
    this.surroundings = new Surroundings(data, this.organs, this.scene);
    this.makeCamera();
    this.makePage();
    this.listen();
    this.look('oblique');
    this.update();
  }

  get nominal() {
    return this.conditions.find(({ name }) => name === this.state.condition).nominal;
  }

  makeCamera() {
    this.camera = new PerspectiveCamera(26, 4 / 3, 10, 3000);
    this.camera.up.set(0, 0, 1);
    const light = new DirectionalLight('#fff', 1.6);
    light.position.set(0.4, 0.6, 1);
    this.camera.add(light);
    this.scene.add(this.camera, new AmbientLight('#fff', 1.7));
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableZoom = false; // until the view is in use: the page must scroll past it
    this.controls.addEventListener('change', () => this.render());
  }

  makePage() {
    const { canvas } = this;
    this.panel = new ViewerPanel(this);
    this.readOut = element('output', { className: 'read-out' });
    this.host.append(
      element('p', { className: 'hint', textContent: 'Drag, or focus and use the arrow keys, to turn; wheel, + and − to come closer once it has focus.' }),
      element('div', { className: 'viewer' },
        element('div', { className: 'stage' }, canvas, this.panel.legend, this.readOut),
        this.panel.element));
    const pictures = document.getElementById('pictures');
    const closed = element('details', {}, element('summary', { textContent: 'Still pictures' }));
    pictures.replaceWith(closed);
    closed.append(pictures);
  }

  get canvas() {
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'Organs in three dimensions, coloured by error');
    return canvas;
  }

  listen() {
    const { domElement: canvas } = this.renderer;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    canvas.addEventListener('focus', () => { this.controls.enableZoom = true; });
    canvas.addEventListener('blur', () => { this.controls.enableZoom = false; });
    canvas.addEventListener('pointerdown', () => canvas.focus({ preventScroll: true }));
    canvas.addEventListener('keydown', (event) => this.key(event));
    canvas.addEventListener('pointermove', (event) => this.hover(event));
    canvas.addEventListener('pointerleave', () => { this.readOut.textContent = ''; });
  }

  set(changes) {
    Object.assign(this.state, changes);
    this.update();
  }

  update() {
    const { step, shown, byOrgan, scale, cut, hidden } = this.state;
    const increment = Math.ceil(step / this.data.model.steps_per_increment);
    this.clipping.length = 0;
    if (cut) this.clipping.push(this.cutPlane());
    const estimate = this.organs.estimate(this.nominal);
    for (const group of this.drawn ?? []) this.scene.remove(group);
    this.drawn = [];
    this.organs.names.forEach((organ, o) => {
      if (hidden.has(organ)) return;
      const show = (surface, frame, back, style) => {
        surface.show(frame, this.organs.errors(this.nominal, o, step, back), { byOrgan, solid: false, wires: false, ...style }, scale);
        this.drawn.push(surface.group);
      };
      if (shown !== 'estimate') show(this.organs.truth[o], increment, false, { solid: true });
      if (shown !== 'truth') show(estimate[o], step, true, shown === 'both' ? { wires: true } : { solid: true });
    });
    if (this.drawn.length) this.scene.add(...this.drawn);
    this.surroundings.show(step, this.nominal, estimate, this.state);
    this.panel.write(increment);
    this.render();
  }

  cutPlane() {
    const { origin, normal } = this.data.model.view.plane;
    return new Plane().setFromNormalAndCoplanarPoint(new Vector3(...normal).negate(), new Vector3(...origin));
  }

  look(name) {
    const points = this.surroundings.plane.children[1].geometry;
    points.computeBoundingSphere();
    const { center, radius } = points.boundingSphere;
    const distance = (0.9 * radius) / Math.sin((this.camera.fov * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(new Vector3(...directions[name]).normalize(), distance);
    this.controls.update();
    this.render();
  }

  showPlace(place) {
    const mark = this.surroundings.mark;
    mark.position.set(...place.position_mm);
    mark.visible = true;
    this.panel.choose(place.condition, place.organ);
    const offset = this.camera.position.clone().sub(this.controls.target);
    this.controls.target.copy(mark.position);
    const side = new Vector3(...this.data.model.view.plane.normal).multiplyScalar(place.offset_mm >= 0 ? 1 : -1);
    this.camera.position.copy(mark.position).addScaledVector(side.add(new Vector3(0, -0.6, 0.3)).normalize(), offset.length());
    this.controls.update();
    this.set({ condition: place.condition, step: this.data.model.steps });
    this.readOut.textContent = `${place.organ}: ${place.error_mm.toFixed(2)} mm, the pink mark`;
    this.host.scrollIntoView({ block: 'start' });
  }

  key(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (event.key in turns) {
      // Spherical angles are about y; the view stands on z
      const angles = new Spherical().setFromVector3(new Vector3(offset.x, offset.z, -offset.y));
      angles.theta += turns[event.key][0] * 0.1;
      angles.phi += turns[event.key][1] * 0.1;
      const turned = new Vector3().setFromSpherical(angles.makeSafe());
      offset.set(turned.x, -turned.z, turned.y);
    } else if (event.key === '+' || event.key === '-') offset.multiplyScalar(event.key === '+' ? 0.9 : 1 / 0.9);
    else return;
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.render();
  }

  hover(event) {
    const box = this.renderer.domElement.getBoundingClientRect();
    const at = new Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const solids = this.drawn.flatMap((group) => group.children).filter((mesh) => mesh.visible && mesh.userData.surface);
    const hit = ray.intersectObjects(solids, false).find(({ point }) => this.clipping.every((plane) => plane.distanceToPoint(point) >= 0));
    this.readOut.textContent = hit ? this.describe(hit) : '';
  }

  describe({ object, face, point }) {
    const { surface } = object.userData, positions = surface.wall.getAttribute('position');
    const nodes = [face.a, face.b, face.c];
    const distance = (node) => new Vector3().fromBufferAttribute(positions, node).distanceTo(point);
    const nearest = nodes.reduce((a, b) => (distance(b) < distance(a) ? b : a));
    const { origin, normal } = this.data.model.view.plane;
    const offset = new Vector3(...normal).dot(point.clone().sub(new Vector3(...origin)));
    const error = surface.errors ? `${surface.errors[nearest].toFixed(2)} mm, ` : '';
    return `${surface.organ}: ${error}${Math.abs(offset).toFixed(0)} mm ${offset >= 0 ? 'left' : 'right'} of the image plane`;
  }

  togglePlay() {
    if (this.timer) {
      clearInterval(this.timer);
      this.timer = null;
    } else {
      if (this.state.step === this.data.model.steps) this.set({ step: 0 });
      this.timer = setInterval(() => {
        this.set({ step: this.state.step + 1 });
        if (this.state.step >= this.data.model.steps) this.togglePlay();
      }, 120);
    }
    this.panel.writePlaying(Boolean(this.timer));
  }

  resize() {
    const { clientWidth: width } = this.renderer.domElement.parentElement;
    const height = Math.round(Math.min((width < 500 ? 0.95 : 0.75) * width, 0.8 * innerHeight));
    if (width === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  render() {
    this.renderer.render(this.scene, this.camera);
  }
}

/** The view in `host`, or null where the browser has no WebGL. */
export function makeViewer(host, data) {
  if (!hasWebGL() || !data.model.conditions.some(({ nominal }) => nominal !== null)) return null;
  try {
    return new Viewer(host, data);
  } catch (error) {
    host.replaceChildren();
    console.warn(`no 3-D view: ${error.message}`);
    return null;
  }
}
