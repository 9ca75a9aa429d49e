// Viridis: even in lightness, readable in grey and for the colour-blind; as the still pictures have it.
import { Color } from 'three';

const anchors = ['#440154', '#482475', '#414487', '#355F8D', '#2A788E', '#21918C', '#22A884', '#44BF70', '#7AD151', '#BDDF26', '#FDE725'];

export const gradient = `linear-gradient(to right, ${anchors.join(', ')})`;

/** 256 colours, linear components as the renderer wants them. */
const table = (() => {
  const colours = anchors.map((anchor) => new Color(anchor));
  const values = new Float32Array(3 * 256);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * (anchors.length - 1), k = Math.min(Math.floor(at), anchors.length - 2);
    new Color().lerpColors(colours[k], colours[k + 1], at - k).toArray(values, 3 * i);
  }
  return values;
})();

/** Writes the colour of value / maximum, clamped to the map's ends, to three places of `target`. */
export function writeColour(target, place, value, maximum) {
  const i = 3 * Math.round(255 * Math.min(Math.max(value / maximum, 0), 1));
  target[place] = table[i];
  target[place + 1] = table[i + 1];
  target[place + 2] = table[i + 2];
}
