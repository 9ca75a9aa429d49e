// What the charts show: curves from the files that the page carries.
import { readCsv } from './payload.js';

const emptyCurve = (abscissae) => ({ mean: abscissae.map(() => null), sd: abscissae.map(() => null), n_runs: abscissae.map(() => 0) });

/** {condition: {organ: {mean: [], sd: [], n_runs: []}}} over the abscissae; null where the file has no row. */
function curvesOf(rows, key, abscissae) {
  const place = new Map(abscissae.map((x, i) => [String(x), i]));
  const curves = {};
  for (const row of rows) {
    const organs = (curves[row.condition] ??= {});
    const curve = (organs[row.organ] ??= emptyCurve(abscissae));
    const i = place.get(row[key]);
    curve.mean[i] = Number(row.mean_mm);
    curve.sd[i] = Number(row.sd_mm);
    curve.n_runs[i] = Number(row.n_runs);
  }
  return curves;
}

function distanceCurves(summary, figure, abscissae, pitch) {
  const curves = {};
  for (const [condition, organs] of Object.entries(summary.errors_by_distance)) {
    curves[condition] = {};
    for (const [organ, slabs] of Object.entries(organs)) {
      const curve = emptyCurve(abscissae);
      for (const slab of slabs) {
        const i = abscissae.indexOf(Math.round((slab.offset_from_mm + slab.offset_to_mm) / 2 / pitch) * pitch);
        curve.mean[i] = slab[figure].mean_mm;
        curve.sd[i] = slab[figure].sd_mm;
        curve.n_runs[i] = slab[figure].n_runs;
      }
      curves[condition][organ] = curve;
    }
  }
  return curves;
}

const range = (first, last, step = 1) => Array.from({ length: Math.floor((last - first) / step) + 1 }, (_, i) => first + i * step);

// Names of metrics_by_step.csv and summary.json, for people.
const metricNames = {
  material_mean_mm: 'material-point error, mean (mm)', material_p95_mm: 'material-point error, 95th percentile (mm)',
  material_max_mm: 'material-point error, largest (mm)', normal_mean_mm: 'its part along the normal (mm)',
  tangential_mean_mm: 'its part along the surface (mm)', symmetric_mean_mm: 'symmetric surface distance (mm)',
  hd95_mm: '95 % Hausdorff distance (mm)', dice: 'Dice', volume_mm3: 'volume (mm³)',
  volume_change_percent: 'volume change (%)', truth_volume_mm3: 'volume of the truth (mm³)',
  truth_volume_change_percent: 'volume change of the truth (%)', rotation_error_rad: 'rotation error (rad)',
  truth_rotation_rad: 'rotation of the truth (rad)',
};

/** What each chart of the page shows. `choices`: what the reader can choose, name to curves. `file`: what its button saves; else
 *  the curves that are shown, under a name that begins with `saves`. */
export function descriptions(data) {
  const { model } = data;
  const summary = JSON.parse(data.text('summary.json'));
  const side = model.slices_each_side, pitch = model.slice_pitch_mm;
  const steps = range(1, model.steps), slices = range(-side, side);
  const positions = range(model.steps_per_increment, model.steps, model.steps_per_increment);
  const middles = Object.values(summary.errors_by_distance).flatMap((organs) => Object.values(organs).flat())
    .map((slab) => Math.round((slab.offset_from_mm + slab.offset_to_mm) / 2 / pitch));
  const offsets = middles.length ? range(Math.min(...middles), Math.max(...middles)).map((bin) => bin * pitch) : [];
  return {
    step: {
      x: steps, xLabel: 'registration step', unit: 'mm', at: (x) => `step ${x}`, bound: 4, file: 'curves_by_step.csv',
      choices: { 'mean surface error (mm)': curvesOf(readCsv(data.text('curves_by_step.csv')), 'step', steps) },
    },
    slice: {
      x: slices, xLabel: 'slice (0: image plane)', unit: 'mm', file: 'curves_by_slice.csv', start: 0,
      at: (x) => `slice ${x > 0 ? '+' : ''}${x}`,
      choices: { 'mean contour error (mm)': curvesOf(readCsv(data.text('curves_by_slice.csv')), 'slice_index', slices) },
    },
    metric: {
      x: positions, xLabel: 'registration step', xName: 'step', saves: 'metric', at: (x) => `step ${x}`, keepStill: true, anyRange: true,
      choices: Object.fromEntries(Object.entries(metricNames).map(([figure, name]) => [name, figureCurves(model, figure)])),
    },
    distance: {
      x: offsets, xLabel: 'offset from the image plane (mm, left positive)', xName: 'offset_mm', saves: 'distance', unit: 'mm', start: 0,
      at: (x) => `${x > 0 ? '+' : ''}${x} mm`,
      choices: {
        'mean surface error (mm)': distanceCurves(summary, 'surface', offsets, pitch),
        'mean material-point error (mm)': distanceCurves(summary, 'material', offsets, pitch),
      },
    },
  };
}

function figureCurves(model, figure) {
  const curves = {};
  for (const [condition, organs] of Object.entries(model.metrics)) {
    curves[condition] = {};
    for (const [organ, figures] of Object.entries(organs)) curves[condition][organ] = figures[figure];
  }
  return curves;
}

/** A chart's curves as CSV: condition,organ,x,n_runs,mean,sd; no row where there is no value. */
export function csvOf(curves, x, xName) {
  const lines = [`condition,organ,${xName},n_runs,mean,sd`];
  for (const [condition, organs] of Object.entries(curves))
    for (const [organ, { mean, sd, n_runs }] of Object.entries(organs))
      x.forEach((at, i) => {
        if (mean[i] !== null) lines.push([condition, organ, at, n_runs[i], mean[i], sd[i]].join(','));
      });
  return `${lines.join('\n')}\n`;
}
