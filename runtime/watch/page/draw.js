// Frames of the daemon (half floats of linear light) to a canvas: exposure and transfer curve are a
// table over all 65536 half floats, so a pixel costs three look-ups.

export function parse_frame(buffer) {
  const view = new DataView(buffer);
  if (buffer.byteLength < 48 || view.getUint32(0, false) !== 0x53434631) return null;
  const word = (i) => view.getInt32(4 + 4 * i, true);
  const frame = {
    generation: word(0), width: word(1), height: word(2), step: word(3),
    x0: word(4), y0: word(5), x1: word(6), y1: word(7),
    columns: word(8), rows: word(9), samples: word(10),
    halves: new Uint16Array(buffer, 48),
  };
  return frame.halves.length === frame.columns * frame.rows * 3 ? frame : null;
}

export function half_value(bits) {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  const size = exponent === 0 ? fraction * 2 ** -24
    : exponent === 31 ? 65504 : (1 + fraction / 1024) * 2 ** (exponent - 15);
  return bits & 0x8000 ? -size : size;
}

function encoded(linear, curve) {
  const c = Math.min(Math.max(linear, 0), 1);
  if (curve === 'course') return Math.floor(255 * c);
  if (curve === 'linear') return Math.floor(255 * c + 0.5);
  const s = c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055;
  return Math.floor(255 * s + 0.5);
}

export class Painter {
  constructor(canvas) {
    this.canvas = canvas;
    this.table = new Uint8Array(65536);
    this.key = '';
    this.small = document.createElement('canvas');
    this.frame = null;
  }

  set_tone(stops, curve) {
    const key = `${stops} ${curve}`;
    if (key === this.key) return false;
    this.key = key;
    const factor = 2 ** stops;
    for (let bits = 0; bits < 0x8000; ++bits) this.table[bits] = encoded(half_value(bits) * factor, curve);
    return true;  // negative light is black: the upper half stays 0
  }

  draw(frame) {
    this.frame = frame;
    const { canvas, small, table } = this;
    if (canvas.width !== frame.width || canvas.height !== frame.height) {
      canvas.width = frame.width;
      canvas.height = frame.height;
    }
    const context = canvas.getContext('2d');
    const image = new ImageData(frame.columns, frame.rows);
    const pixels = new Uint32Array(image.data.buffer);
    const halves = frame.halves;
    for (let i = 0, j = 0; i < pixels.length; ++i, j += 3) {
      pixels[i] = 0xff000000 | table[halves[j + 2]] << 16 | table[halves[j + 1]] << 8 | table[halves[j]];
    }
    const w = frame.x1 - frame.x0;
    const h = frame.y1 - frame.y0;
    if (frame.columns === w && frame.rows === h) {
      context.putImageData(image, frame.x0, frame.y0);
      return;
    }
    small.width = frame.columns;
    small.height = frame.rows;
    small.getContext('2d').putImageData(image, 0, 0);
    context.imageSmoothingEnabled = true;
    context.drawImage(small, frame.x0, frame.y0, w, h);
  }

  redraw() {
    if (this.frame) this.draw(this.frame);
  }
}
