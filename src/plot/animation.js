// Plays the animation of the grains on its canvas, over and over.
(() => {
"use strict";
const RATE = 25; // frames a second
const TALLEST = 440; // pixels

/** The colour of a share of the largest velocity. */
function shades(colours) {
  const stops = colours.split(" ").map(c => [1, 3, 5].map(i => parseInt(c.slice(i, i + 2), 16)));
  return Array.from({ length: 64 }, (_, n) => {
    const at = n / 63 * (stops.length - 1);
    const i = Math.min(Math.floor(at), stops.length - 2);
    return `rgb(${stops[i].map((c, k) => Math.round(c + (at - i) * (stops[i + 1][k] - c))).join(" ")})`;
  });
}

class Animation {
  constructor(figure) {
    this.canvas = figure.querySelector("canvas");
    const d = this.canvas.dataset;
    for (const name of ["begin", "interval", "frames", "grains", "radius", "length", "shown", "bottom", "top"]) this[name] = Number(d[name]);
    const bytes = Uint8Array.from(atob(d.places), c => c.charCodeAt(0));
    this.places = new Uint16Array(bytes.buffer);
    this.shades = shades(d.colours);
    this.measure();
    [this.button, this.slider, this.clock] = ["button", "input", "output"].map(name => figure.querySelector(name));
    this.at = 0;
    this.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    figure.hidden = false;
    const still = document.getElementById("drawing");
    if (still) still.hidden = true;
    this.button.addEventListener("click", () => this.play(!this.playing));
    this.slider.addEventListener("input", () => { this.play(false); this.at = Number(this.slider.value); this.draw(); });
    addEventListener("resize", () => this.draw());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    this.play(this.playing);
    this.draw();
  }

  x(frame, grain) { return this.places[2 * (frame * this.grains + grain)] / 65536 * this.length; }
  z(frame, grain) { return this.bottom + this.places[2 * (frame * this.grains + grain) + 1] / 65535 * (this.top - this.bottom); }

  /** Way along the flow to the next frame; the length is a period. */
  way(frame, grain) {
    const step = (this.x(frame + 1, grain) - this.x(frame, grain)) / this.length;
    return (step - Math.round(step)) * this.length;
  }

  /** The part that is shown, and the velocities at the ends of the colours. */
  measure() {
    const speeds = new Float64Array((this.frames - 1) * this.grains);
    let [low, high] = [Infinity, -Infinity];
    for (let p = 0; p < this.frames; p++) for (let g = 0; g < this.grains; g++) {
      const z = this.z(p, g);
      [low, high] = [Math.min(low, z), Math.max(high, z)];
      if (p + 1 < this.frames) speeds[p * this.grains + g] = this.way(p, g) / this.interval;
    }
    speeds.sort();
    // Slower than this is the rounding of the places.
    const least = 20 * this.length / 65536 / this.interval;
    const slow = speeds[Math.floor(0.002 * speeds.length)];
    this.slow = slow < -least ? slow : 0;
    this.fast = Math.max(least, speeds[Math.floor(0.998 * (speeds.length - 1))]);
    this.low = low - this.radius;
    this.high = high + this.radius;
  }

  play(on) {
    this.playing = on;
    this.button.textContent = on ? "Pause" : "Play";
    if (on) requestAnimationFrame(now => { this.last = now; this.go(now); });
  }

  go(now) {
    if (!this.playing) return;
    this.at = (this.at + (now - this.last) / 1000 * RATE) % (this.frames - 1);
    this.last = now;
    const { top, bottom } = this.canvas.getBoundingClientRect();
    if (bottom > 0 && top < innerHeight) this.draw();
    requestAnimationFrame(next => this.go(next));
  }

  draw() {
    const style = getComputedStyle(this.canvas);
    const room = this.canvas.parentElement.clientWidth;
    const scale = Math.min(room / this.shown, TALLEST / (this.high - this.low));
    const [width, height] = [scale * this.shown, scale * (this.high - this.low)];
    // Under a narrow canvas the length has a line of its own.
    const narrow = width < 480;
    const [wide, below] = [Math.max(width, Math.min(room, 300)), narrow ? 44 : 26];
    const dense = devicePixelRatio || 1;
    this.canvas.width = Math.round(dense * wide);
    this.canvas.height = Math.round(dense * (height + below));
    this.canvas.style.width = `${wide}px`;
    const to = this.canvas.getContext("2d");
    to.scale(dense, dense);
    const [frame, r] = [Math.min(Math.floor(this.at), this.frames - 2), scale * this.radius];
    const part = this.at - frame;
    to.save();
    to.beginPath();
    to.rect(0, 0, width, height);
    to.clip();
    to.strokeStyle = style.getPropertyValue("--paper");
    to.lineWidth = Math.max(0.6, 0.12 * r);
    for (let g = 0; g < this.grains; g++) {
      const way = this.way(frame, g);
      const x = this.x(frame, g) + part * way;
      const z = (1 - part) * this.z(frame, g) + part * this.z(frame + 1, g);
      const share = (way / this.interval - this.slow) / (this.fast - this.slow || 1);
      to.fillStyle = this.shades[Math.round(63 * Math.min(1, Math.max(0, share)))];
      // What leaves at one end of the period comes in at the other.
      for (const shift of [0, -this.length, this.length]) {
        const left = scale * (x + shift);
        if (left < -r || left > width + r) continue;
        to.beginPath();
        to.arc(left, scale * (this.high - z), r, 0, 2 * Math.PI);
        to.fill();
        to.stroke();
      }
    }
    to.restore();
    const bar = Math.min(160, 0.3 * wide);
    for (let i = 0; i < 64; i++) {
      to.fillStyle = this.shades[i];
      to.fillRect(i / 64 * bar, height + 10, bar / 64 + 0.5, 8);
    }
    to.fillStyle = style.getPropertyValue("--ink");
    to.font = "12px system-ui, sans-serif";
    const velocity = u => (Math.abs(u) < 0.005 * this.fast ? "0" : u.toPrecision(2)).replace("-", "−");
    to.fillText(`velocity ${velocity(this.slow)} to ${velocity(this.fast)} m/s`, bar + 8, height + 18);
    to.textAlign = narrow ? "left" : "right";
    const whole = this.shown < this.length ? ` of the period of ${this.length.toPrecision(3)} m` : "";
    to.fillText(`length ${this.shown.toPrecision(3)} m${whole}`, narrow ? 0 : width, height + (narrow ? 36 : 18));
    this.slider.value = this.at;
    const slower = 1 / (RATE * this.interval);
    const rate = slower < 1 ? `${(1 / slower).toPrecision(2)} times faster` : `${slower.toPrecision(2)} times slower`;
    this.clock.textContent = `t = ${(this.begin + this.at * this.interval).toFixed(3)} s, ${rate} than in nature`;
  }
}

for (const figure of document.querySelectorAll("figure#animation")) new Animation(figure);
})();
