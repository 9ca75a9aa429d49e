// The data that the page carries (validation/report/payload.h): a JSON head and named parts.

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function readPayload(text) {
  const bytes = await inflated(text);
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const part = (name) => {
    const place = head.parts[name];
    if (!place) throw new Error(`the page's data have no part ${name}`);
    const begin = 4 + length + place[0];
    return bytes.subarray(begin, begin + place[1]);
  };
  return { model: head.model, part, has: (name) => name in head.parts, text: (name) => new TextDecoder().decode(part(name)) };
}

/** uint16 numbers whose low bytes stand before all high bytes. */
export function unpackIndices(bytes) {
  const n = bytes.length / 2;
  const words = new Uint16Array(n);
  for (let i = 0; i < n; ++i) words[i] = bytes[i] | (bytes[n + i] << 8);
  return words;
}

const unfolded = (word) => (word & 1 ? -(word + 1) / 2 : word / 2);

/** Frames of 3 n coordinates in mm. */
export function unpackPositions(bytes, nNodes, quantum) {
  const words = unpackIndices(bytes);
  const size = 3 * nNodes;
  const now = new Int16Array(size);
  const frames = [];
  for (let begin = 0; begin < words.length; begin += size) {
    const frame = new Float32Array(size);
    for (let i = 0; i < size; ++i) {
      now[i] += unfolded(words[begin + i]);
      frame[i] = now[i] * quantum;
    }
    frames.push(frame);
  }
  return frames;
}

/** Frames of n values in mm. */
export function unpackValues(bytes, n, quantum) {
  const now = new Uint8Array(n);
  const frames = [];
  for (let begin = 0; begin < bytes.length; begin += n) {
    const frame = new Float32Array(n);
    for (let i = 0; i < n; ++i) {
      now[i] += unfolded(bytes[begin + i]);
      frame[i] = now[i] * quantum;
    }
    frames.push(frame);
  }
  return frames;
}

/** Rows of a CSV file without quotes, as objects of texts. */
export function readCsv(text) {
  const [heading, ...lines] = text.trim().split('\n');
  const names = heading.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((cell, i) => [names[i], cell])));
}
