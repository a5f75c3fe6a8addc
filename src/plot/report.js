// Makes the figures of a page answer: values under the pointer, one elevation in all profiles, curves that come and go.
// The page says everything without it.
(() => {
"use strict";
const all = (selector, root = document) => [...root.querySelectorAll(selector)];
const SNAP = 320; // how near a curve must be to be read, in the drawing's grid: 10 to a unit, about 11 to a pixel
const DIGITS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** Four digits as they are printed: −1.234 × 10⁻⁵. */
function shown(x, unit) {
  const size = Math.abs(x);
  let text = x.toPrecision(4);
  if (size === 0) text = "0";
  else if (size < 1e-3 || size >= 1e5) {
    const [digits, power] = x.toExponential(3).split("e");
    text = `${digits} × 10${[...power.replace("+", "")].map(c => DIGITS[c] ?? "⁻").join("")}`;
  }
  return text.replace("-", "−") + (unit ? `\u00a0${unit}` : "");
}

/** An axis: values to places in the drawing and back, exactly as it was drawn. */
function axis(text, title, unit, from, to) {
  const [low, high, kind] = text.split(" ");
  const [bend, back] = kind === "log" ? [Math.log, Math.exp] : [Number, Number];
  const [a, b] = [bend(low), bend(high)];
  return {
    title, unit,
    at: value => from + (bend(value) - a) / (b - a) * (to - from),
    value: place => back(a + (place - from) / (to - from) * (b - a)),
  };
}

function element(parent, name, text = "", className = "") {
  const made = document.createElementNS(parent.namespaceURI, name);
  made.textContent = text;
  if (className) made.setAttribute("class", className);
  return parent.appendChild(made);
}

function line(parent, x1, y1, x2, y2) {
  const made = element(parent, "path", "", "cross");
  made.setAttribute("d", `M${x1} ${y1}L${x2} ${y2}`);
}

function ring(parent, [x, y], colour) {
  const made = element(parent, "circle", "", "ring");
  for (const [key, value] of Object.entries({ cx: x, cy: y, r: 38 })) made.setAttribute(key, value);
  made.style.stroke = `var(--${colour})`;
}

class Plot {
  constructor(svg) {
    this.svg = svg;
    this.frame = svg.closest("figure");
    this.panes = all("rect.pane", svg).map(({ dataset: d, x, y, width, height }) => {
      const [left, top] = [x.baseVal.value, y.baseVal.value];
      const [right, bottom] = [left + width.baseVal.value, top + height.baseVal.value];
      const across = axis(d.x, d.xTitle, d.xUnit, left, right);
      return { left, top, right, bottom, x: across, y: axis(d.y, d.yTitle, d.yUnit, bottom, top), link: d.link };
    });
    this.link = this.panes[0]?.link;
    this.curves = all("g.curve", svg).map(g => {
      const { name, colour, key, points, marked } = g.dataset;
      const pane = this.panes[g.dataset.panel];
      const place = pair => { const [x, y] = pair.split(","); return [pane.x.at(x), pane.y.at(y)]; };
      const pieces = points ? points.split(";").map(piece => piece.split(" ").map(place)) : [];
      return { g, pane, name, colour, key, pieces, marked: marked !== undefined };
    });
    this.live = element(svg, "g", "", "live");
    this.readout = element(this.frame, "div", "", "readout");
    this.readout.hidden = true;
    // What a browser would show of its own accord beside the values.
    const caption = svg.querySelector("title");
    if (caption) { svg.setAttribute("aria-label", caption.textContent); caption.remove(); }
    this.notes = all("circle.hit", svg).map(circle => {
      const note = { x: circle.cx.baseVal.value, y: circle.cy.baseVal.value, text: circle.textContent };
      circle.remove();
      return note;
    });
    this.legend();
    svg.addEventListener("pointermove", event => this.point(event));
    svg.addEventListener("pointerdown", event => this.point(event));
    svg.addEventListener("pointerleave", () => hide(this));
  }

  /** Entries of the legend become buttons. */
  legend() {
    for (const key of all("g.key", this.svg)) {
      const { x, y, width, height } = key.getBBox();
      const area = element(key, "rect", "", "area");
      for (const [k, v] of Object.entries({ x: x - 30, y: y - 10, width: width + 60, height: height + 20 })) area.setAttribute(k, v);
      for (const [k, v] of Object.entries({ role: "button", tabindex: 0, "aria-pressed": true })) key.setAttribute(k, v);
      key.setAttribute("aria-label", `show ${key.querySelector("text")?.textContent.trim()}`);
      const toggle = () => {
        const on = key.getAttribute("aria-pressed") !== "true";
        key.setAttribute("aria-pressed", on);
        for (const curve of this.curves) if (curve.key === key.dataset.key) curve.g.classList.toggle("off", !on);
        hide(this);
      };
      key.addEventListener("click", toggle);
      key.addEventListener("keydown", event => {
        if (event.key === "Enter" || event.key === " ") { event.preventDefault(); toggle(); }
      });
    }
    if (all("g.key", this.svg).length) this.svg.setAttribute("role", "group");
  }

  visible(pane) { return this.curves.filter(c => c.pane === pane && !c.g.classList.contains("off")); }

  point(event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    const pane = this.panes.find(p => at.x >= p.left && at.x <= p.right && at.y >= p.top && at.y <= p.bottom);
    if (!pane) return hide(this);
    if (this.link === undefined) return this.near(pane, at, event);
    const level = pane.y.value(at.y);
    for (const plot of plots) if (plot.link === this.link) plot.level(level);
  }

  /** The values of all curves at one elevation, each panel's below it. */
  level(value) {
    this.clear();
    const [first] = this.panes;
    const y = first.y.at(value);
    if (!(y >= first.top - 1 && y <= first.bottom + 1)) return;
    element(this.readout, "p", `${first.y.title} = ${shown(value, first.y.unit)}`);
    const { width } = this.svg.viewBox.baseVal;
    const [box, outer] = [this.svg.getBoundingClientRect(), this.frame.getBoundingClientRect()];
    // Where the panels are too narrow for their values, these stand in rows of their own.
    const narrow = this.panes.some(pane => box.width * (pane.right - pane.left) / width < 110);
    this.readout.classList.toggle("narrow", narrow);
    let height = 0;
    for (const pane of this.panes) {
      line(this.live, pane.left, y, pane.right, y);
      const column = element(this.readout, "div", "", "column");
      if (!narrow) {
        column.style.left = `${box.left - outer.left + box.width * pane.left / width}px`;
        column.style.width = `${box.width * (pane.right - pane.left) / width}px`;
      }
      element(column, "i", pane.x.title);
      for (const curve of this.visible(pane)) {
        const x = crossing(curve, y);
        if (x !== undefined) ring(this.live, [x, y], curve.colour);
        row(column, curve, x === undefined ? "–" : shown(pane.x.value(x), pane.x.unit));
      }
      height = Math.max(height, column.offsetTop + column.offsetHeight);
    }
    Object.assign(this.readout.style, { top: `${box.bottom - outer.top}px`, height: narrow ? "auto" : `${height + 6}px` });
  }

  /** The point of a curve that is nearest to the pointer, or the place of the pointer itself. */
  near(pane, at, event) {
    this.clear();
    let [best, place, found] = [SNAP, [at.x, at.y], undefined];
    for (const curve of this.visible(pane)) for (const candidate of candidates(curve, at)) {
      const distance = Math.hypot(candidate[0] - at.x, candidate[1] - at.y);
      if (distance < best) [best, place, found] = [distance, candidate, curve];
    }
    const [x, y] = place;
    line(this.live, pane.left, y, pane.right, y);
    line(this.live, x, pane.top, x, pane.bottom);
    this.readout.classList.add("near");
    if (found) {
      ring(this.live, place, found.colour);
      if (found.name) row(this.readout, found, "");
    }
    for (const [axis, p] of [[pane.x, x], [pane.y, y]]) element(this.readout, "p", `${axis.title}: ${shown(axis.value(p), axis.unit)}`);
    const note = found && this.notes.find(n => Math.hypot(n.x - x, n.y - y) < 2);
    if (note) element(this.readout, "p", note.text, "note");
    const outer = this.frame.getBoundingClientRect();
    const left = event.clientX - outer.left;
    const flip = left + 24 + this.readout.offsetWidth > outer.width;
    this.readout.style.left = `${Math.max(0, flip ? left - 16 - this.readout.offsetWidth : left + 16)}px`;
    this.readout.style.top = `${event.clientY - outer.top + 14}px`;
  }

  clear() {
    this.live.replaceChildren();
    this.readout.replaceChildren();
    this.readout.removeAttribute("style");
    this.readout.className = "readout";
    this.readout.hidden = false;
  }
}

function row(parent, curve, value) {
  const made = element(parent, "div", "", "row");
  element(made, "b").style.background = `var(--${curve.colour})`;
  element(made, "span", curve.name);
  element(made, "span", value, "value");
}

/** Where a curve crosses a height of the drawing, or has a point beside it. */
function crossing({ pieces, marked }, y) {
  for (const piece of pieces) for (let i = 0; i + 1 < piece.length && !marked; i++) {
    const [[x0, y0], [x1, y1]] = [piece[i], piece[i + 1]];
    if ((y0 - y) * (y1 - y) <= 0) return y0 === y1 ? x0 : x0 + (y - y0) / (y1 - y0) * (x1 - x0);
  }
  const beside = pieces.flat().map(p => [Math.abs(p[1] - y), p[0]]).sort((a, b) => a[0] - b[0])[0];
  return beside && beside[0] < (marked ? 60 : 15) ? beside[1] : undefined;
}

/** Points of a curve that may be the nearest: its markers, or one on each straight piece of its line. */
function candidates({ pieces, marked }, at) {
  if (marked) return pieces.flat();
  return pieces.flatMap(piece => piece.map(([x0, y0], i) => {
    const [x1, y1] = piece[i + 1] ?? [x0, y0];
    const square = (x1 - x0) ** 2 + (y1 - y0) ** 2;
    const share = square ? ((at.x - x0) * (x1 - x0) + (at.y - y0) * (y1 - y0)) / square : 0;
    const t = Math.min(1, Math.max(0, share));
    return [x0 + t * (x1 - x0), y0 + t * (y1 - y0)];
  }));
}

function hide(of) {
  for (const plot of plots) if (plot === of || (of.link !== undefined && plot.link === of.link)) {
    plot.clear();
    plot.readout.hidden = true;
  }
}

const plots = all("svg.plot").map(svg => new Plot(svg));
document.documentElement.dataset.ready = "true";
})();
