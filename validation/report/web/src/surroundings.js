// What stands around the organs: image plane, control points, bars, attachments, a mark.
import { BufferAttribute, BufferGeometry, DoubleSide, Group, LineBasicMaterial, LineLoop, LineSegments, Mesh, MeshBasicMaterial, Points,
  PointsMaterial, SphereGeometry, Vector3 } from 'three';
import { unpackPositions } from './payload.js';

/** Rectangle of the plane that holds the points (flat list), with a margin, mm. */
export function planeRectangle(plane, positions, margin = 6) {
  const origin = new Vector3(...plane.origin), normal = new Vector3(...plane.normal);
  const up = new Vector3(0, 0, 1).addScaledVector(normal, -normal.z).normalize();
  const right = new Vector3().crossVectors(up, normal);
  const lower = [Infinity, Infinity], upper = [-Infinity, -Infinity], p = new Vector3();
  for (const list of positions)
    for (let i = 0; i < list.length; i += 3) {
      p.fromArray(list, i).sub(origin);
      [p.dot(right), p.dot(up)].forEach((x, axis) => {
        lower[axis] = Math.min(lower[axis], x - margin);
        upper[axis] = Math.max(upper[axis], x + margin);
      });
    }
  return [[lower[0], lower[1]], [upper[0], lower[1]], [upper[0], upper[1]], [lower[0], upper[1]]].map(([a, b]) =>
    origin.clone().addScaledVector(right, a).addScaledVector(up, b));
}

function imagePlane(corners) {
  const geometry = new BufferGeometry().setFromPoints(corners);
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const sheet = new Mesh(geometry, new MeshBasicMaterial({ color: '#5a8fd6', transparent: true, opacity: 0.18, side: DoubleSide, depthWrite: false }));
  const border = new LineLoop(new BufferGeometry().setFromPoints(corners), new LineBasicMaterial({ color: '#2f5fa8' }));
  return new Group().add(sheet, border);
}

const cloud = (colour, size) => new Points(new BufferGeometry(), new PointsMaterial({ color: colour, size, sizeAttenuation: false }));

function setPositions(object, values) {
  object.geometry.setAttribute('position', new BufferAttribute(values, 3));
  object.geometry.computeBoundingSphere();
}

export class Surroundings {
  constructor(data, organs, scene) {
    this.view = data.model.view;
    this.organs = organs;
    this.stepsPerIncrement = data.model.steps_per_increment;
    this.plane = imagePlane(planeRectangle(this.view.plane, organs.truth.flatMap((surface) => [surface.frames[0], surface.frames.at(-1)])));
    this.controlPoints = cloud('#111', 5 * devicePixelRatio);
    this.attachments = cloud('#D55E00', 5 * devicePixelRatio);
    this.bars = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: '#8aa6bd' }));
    this.barFrames = data.has('bars') ? unpackPositions(data.part('bars'), 2 * this.view.bars, this.view.bar_quantum_mm) : null;
    this.mark = new Mesh(new SphereGeometry(2, 24, 16), new MeshBasicMaterial({ color: '#ff2d95' }));
    this.mark.visible = false;
    scene.add(this.plane, this.controlPoints, this.attachments, this.bars, this.mark);
  }

  has(what) {
    return { controlPoints: this.view.control_points.length > 0, attachments: this.view.attachments.some((organs) => organs.some((nodes) => nodes.length > 0)), bars: this.barFrames !== null }[what] ?? true;
  }

  /** nominal, estimate: place and surfaces of the condition. */
  show(step, nominal, estimate, visible) {
    const increment = Math.ceil(step / this.stepsPerIncrement);
    this.plane.visible = visible.plane;
    this.controlPoints.visible = visible.controlPoints && this.has('controlPoints');
    this.attachments.visible = visible.attachments && this.has('attachments');
    this.bars.visible = visible.bars && this.has('bars');
    if (this.controlPoints.visible) setPositions(this.controlPoints, new Float32Array(this.view.control_points[increment]));
    if (this.bars.visible) setPositions(this.bars, this.barFrames[increment]);
    if (this.attachments.visible) setPositions(this.attachments, this.attachmentNodes(step, nominal, estimate));
  }

  attachmentNodes(step, nominal, estimate) {
    const values = [];
    this.view.attachments[nominal].forEach((nodes, organ) => {
      const positions = estimate[organ].nodes(step);
      for (const node of nodes) values.push(...positions.subarray(3 * node, 3 * node + 3));
    });
    return new Float32Array(values);
  }
}
