// The camera under the mouse: it turns round the point it looks at, slides sideways and comes nearer.

const add = (a, b, s = 1) => a.map((v, i) => v + s * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scale = (a, s) => a.map((v) => v * s);
const length = (a) => Math.hypot(...a);
const unit = (a) => scale(a, 1 / (length(a) || 1));

// About a unit axis (Rodrigues).
function rotate(v, axis, angle) {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return add(add(scale(v, c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
}

export class OrbitCamera {
  constructor(wish) {
    this.wish = wish;
    this.view = null;
    this.moved_at = -1e9;
  }

  take(camera, size) {
    // What the mouse has just done is ahead of what the daemon says.
    if (performance.now() - this.moved_at < 500) return;
    const aim = camera.aim ?? add(camera.eye, unit(camera.direction), 5);
    this.view = { eye: camera.eye, aim, up: unit(camera.up) };
    this.half_height = camera.half_height ?? 0.5;
    this.size = size;
  }

  send() {
    this.moved_at = performance.now();
    this.wish({ ...this.view });
  }

  axes() {
    const back = add(this.view.eye, this.view.aim, -1);
    const right = unit(cross(this.view.up, back));
    return { back, right, up: unit(cross(back, right)) };
  }

  turn(dx, dy, canvas) {
    if (!this.view) return;
    const { back, right } = this.axes();
    const per_pixel = Math.PI / canvas.height;
    let turned = rotate(back, this.view.up, -dx * per_pixel);
    const side = rotate(right, this.view.up, -dx * per_pixel);
    // Not over the pole: the picture would turn upside down.
    const height = Math.acos(Math.min(Math.max(dot(unit(turned), this.view.up), -1), 1));
    const step = Math.min(Math.max(-dy * per_pixel, 0.02 - height), Math.PI - 0.02 - height);
    turned = rotate(turned, side, step);
    this.view.eye = add(this.view.aim, turned);
    this.send();
  }

  pan(dx, dy, canvas) {
    if (!this.view) return;
    const { back, right, up } = this.axes();
    const per_pixel = 2 * this.half_height * length(back) / canvas.height;
    const step = add(scale(right, -dx * per_pixel), up, dy * per_pixel);
    this.view.eye = add(this.view.eye, step);
    this.view.aim = add(this.view.aim, step);
    this.send();
  }

  dolly(factor) {
    if (!this.view) return;
    this.view.eye = add(this.view.aim, scale(this.axes().back, factor));
    this.send();
  }

  // Whether the key means something to the camera.
  key(event) {
    const canvas = event.target;
    const step = canvas.height / 30;
    const move = event.shiftKey ? 'pan' : 'turn';
    const steps = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (steps[event.key]) this[move](...steps[event.key], canvas);
    else if (event.key === '+' || event.key === '=') this.dolly(0.9);
    else if (event.key === '-') this.dolly(1 / 0.9);
    else return false;
    return true;
  }
}
