// Puts life into a page that is whole without it.
import { makeCharts } from './charts.js';
import { element } from './dom.js';
import { readPayload } from './payload.js';
import { makeSlices } from './slices.js';
import { makeViewer } from './viewer.js';
import { linkWorstPlaces } from './worst.js';

function say(host, text) {
  host.prepend(element('p', { className: 'note', textContent: text }));
}

async function start() {
  const viewerHost = document.getElementById('viewer');
  if (typeof DecompressionStream === 'undefined') {
    say(viewerHost, 'This browser is too old for the charts and the 3-D view; the still figures show the same results.');
    return;
  }
  const data = await readPayload(document.getElementById('data').textContent);
  makeCharts(data);
  makeSlices(data);
  const viewer = makeViewer(viewerHost, data);
  if (viewer) linkWorstPlaces(data, viewer);
  else say(viewerHost, 'This browser has no WebGL, which the 3-D view needs: these are still pictures.');
  document.documentElement.dataset.ready = viewer ? 'all' : 'no-webgl';
}

start();
