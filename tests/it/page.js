// Does on a page what a reader does and writes what the page answers into an attribute of its root, as JSON.
(async () => {
"use strict";
const all = (selector, root = document) => [...root.querySelectorAll(selector)];
const root = document.documentElement;
const frame = () => new Promise(done => setTimeout(done, 50));

function hover(svg, panel, across, up) {
  const box = all("rect.pane", svg)[panel].getBoundingClientRect();
  const [clientX, clientY] = [box.left + across * box.width, box.bottom - up * box.height];
  svg.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY, bubbles: true }));
}

const shown = () => all(".readout").filter(r => !r.hidden).map(r => r.innerText);
const crosses = svg => all(".live .cross", svg).map(c => c.getAttribute("d"));

function light(colour) {
  const [r, g, b] = colour.match(/[\d.]+/g).map(c => (c / 255) ** 2.2);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
}

function legends(svg) {
  const key = svg.querySelector("g.key");
  if (!key) return null;
  const hidden = () => all("g.curve.off", svg).length;
  const counts = [hidden()];
  key.dispatchEvent(new MouseEvent("click", { bubbles: true }));
  counts.push(hidden());
  const pressed = key.getAttribute("aria-pressed");
  key.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
  counts.push(hidden());
  return { counts, pressed };
}

async function animation(figure) {
  const [canvas, button, slider, clock] = ["canvas", "button", "input", "output"].map(name => figure.querySelector(name));
  const colours = () => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size;
  };
  figure.scrollIntoView();
  const begin = clock.textContent;
  for (let i = 0; i < 50 && clock.textContent === begin; i++) await frame();
  const later = clock.textContent;
  button.click();
  const reported = button.textContent;
  const stopped = clock.textContent;
  await frame();
  const still = clock.textContent === stopped;
  slider.value = slider.max;
  slider.dispatchEvent(new Event("input"));
  return { begin, later, reported, still, end: clock.textContent, colours: colours(), hidden: figure.hidden, drawing: document.getElementById("drawing")?.hidden };
}

const answer = {};
try {
  const style = getComputedStyle(document.body);
  const lights = [light(style.color), light(style.backgroundColor)].sort((a, b) => b - a);
  answer.contrast = lights[0] / lights[1];
  answer.dark = light(style.backgroundColor) < light(style.color);
  answer.loaded = performance.getEntriesByType("resource").length;
  answer.wide = root.scrollWidth > root.clientWidth;
  answer.plots = all("svg.plot").map(svg => {
    hover(svg, 0, 0.5, 0.4);
    const found = { panels: all("rect.pane", svg).length, curves: all("g.curve", svg).length, reported: shown(), crosses: crosses(svg) };
    svg.dispatchEvent(new PointerEvent("pointerleave"));
    return { ...found, left: shown().length, legend: legends(svg) };
  });
  const figure = document.getElementById("animation");
  if (figure) answer.animation = await animation(figure);
} catch (error) {
  answer.error = String(error);
}
root.dataset.probe = JSON.stringify(answer);
})();
