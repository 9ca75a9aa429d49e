// The moving surfaces of the 3-D view.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial } from 'three';
import { writeColour } from './colour_map.js';
import { unpackIndices, unpackPositions, unpackValues } from './payload.js';

const organColours = { bladder: '#E0B93A', vagina: '#E0849A', uterus: '#A65C90', rectum: '#936440' };
const plain = new Color('#c9c9c9');

/** One organ of the truth or of an estimate: positions by frame, drawn with colours or as a wire mesh. */
class Surface {
  constructor(data, name, frames, organ, clipping) {
    this.frames = frames;
    this.organ = organ;
    this.errors = null;
    const positions = new BufferAttribute(new Float32Array(frames[0].length), 3);
    this.colours = new BufferAttribute(new Float32Array(frames[0].length), 3);
    this.wall = new BufferGeometry();
    this.wall.setAttribute('position', positions);
    this.wall.setAttribute('color', this.colours);
    this.wall.setIndex(new BufferAttribute(unpackIndices(data.part(`${name}/wall`)), 1));
    this.caps = new BufferGeometry();
    this.caps.setAttribute('position', positions);
    this.caps.setIndex(new BufferAttribute(unpackIndices(data.part(`${name}/caps`)), 1));
    const coloured = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, clippingPlanes: clipping });
    const grey = new MeshLambertMaterial({ color: plain, side: DoubleSide, clippingPlanes: clipping });
    const wires = new MeshBasicMaterial({ color: '#222', wireframe: true, transparent: true, opacity: 0.35, clippingPlanes: clipping });
    this.solid = new Mesh(this.wall, coloured);
    this.solid.userData.surface = this;
    this.lids = new Mesh(this.caps, grey);
    this.net = new Mesh(this.wall, wires);
    this.group = new Group();
    this.group.add(this.solid, this.lids, this.net);
  }

  /** frame: of positions. errors: of its nodes at the step, or null. */
  show(frame, errors, style, scale) {
    const positions = this.wall.getAttribute('position');
    positions.array.set(this.frames[Math.min(frame, this.frames.length - 1)]);
    positions.needsUpdate = true;
    this.errors = errors;
    const base = style.byOrgan ? new Color(organColours[this.organ] ?? '#888') : plain;
    for (let i = 0; i < positions.count; ++i)
      if (errors && !style.byOrgan) writeColour(this.colours.array, 3 * i, errors[i], scale);
      else base.toArray(this.colours.array, 3 * i);
    this.colours.needsUpdate = true;
    this.solid.visible = this.lids.visible = style.solid;
    this.net.visible = style.wires;
    if (style.solid) {
      this.wall.computeVertexNormals();
      this.caps.computeVertexNormals();
    }
    this.wall.computeBoundingSphere();
    this.caps.boundingSphere = this.wall.boundingSphere;
  }

  nodes(frame) {
    return this.frames[Math.min(frame, this.frames.length - 1)];
  }
}

/** Truth and estimates, unpacked when first shown. */
export class Organs {
  constructor(data, clipping) {
    this.data = data;
    this.clipping = clipping;
    this.view = data.model.view;
    this.names = data.model.organs;
    this.cache = new Map();
    this.truth = this.names.map((organ, o) => this.surface(`truth/${o}`, organ, this.view.truth_nodes[o]));
  }

  once(key, make) {
    if (!this.cache.has(key)) this.cache.set(key, make());
    return this.cache.get(key);
  }

  surface(name, organ, nNodes) {
    return this.once(name, () => {
      const frames = unpackPositions(this.data.part(name), nNodes, this.view.quantum_mm);
      return new Surface(this.data, name, frames, organ, this.clipping);
    });
  }

  estimate(condition) {
    return this.names.map((organ, o) => this.surface(`estimate/${condition}/${o}`, organ, this.view.estimate_nodes[condition][o]));
  }

  /** Errors of the nodes of an organ at a step, mm; back: of the estimate's nodes. */
  errors(condition, o, step, back) {
    if (step === 0) return null;
    const name = `${back ? 'error_back' : 'error'}/${condition}/${o}`;
    const n = (back ? this.estimate(condition) : this.truth)[o].frames[0].length / 3;
    return this.once(name, () => unpackValues(this.data.part(name), n, this.view.error_quantum_mm))[step - 1];
  }
}
