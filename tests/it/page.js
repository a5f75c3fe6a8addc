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

/** What cannot be read in a drawing, as it is laid out by the browser. */
function faults(svg) {
  const found = [];
  const sheet = svg.getBoundingClientRect();
  const texts = all("text", svg).map(t => ({ words: t.textContent.trim(), box: t.getBoundingClientRect() })).filter(t => t.words);
  const slack = 1;
  texts.forEach(({ words, box }, i) => {
    if (box.left < sheet.left - slack || box.right > sheet.right + slack || box.top < sheet.top - slack || box.bottom > sheet.bottom + slack)
      found.push(`${words} leaves the sheet`);
    // The box of a line of text is taller than its letters.
    const [high, low] = [box.top + 0.2 * Math.min(box.width, box.height), box.bottom - 0.2 * Math.min(box.width, box.height)];
    for (const other of texts.slice(0, i))
      if (box.left + slack < other.box.right && other.box.left + slack < box.right && high < other.box.bottom && other.box.top < low)
        found.push(`${words} lies on ${other.words}`);
  });
  const panes = all("rect.pane", svg).map(pane => pane.getBBox());
  const curves = all("g.curve", svg);
  for (const g of curves) {
    const [pane, box, most] = [panes[g.dataset.panel], g.getBBox(), 60];
    if (!g.dataset.points) continue;
    if (box.x < pane.x - most || box.y < pane.y - most || box.x + box.width > pane.x + pane.width + most || box.y + box.height > pane.y + pane.height + most)
      found.push(`${g.dataset.name} leaves its panel`);
  }
  for (const key of all("g.key", svg))
    if (!curves.some(g => g.dataset.key === key.dataset.key && g.dataset.points)) found.push(`${key.textContent.trim()} is not drawn`);
  const points = panes.map((_, i) => curves.filter(g => Number(g.dataset.panel) === i).map(g => g.dataset.points).join("|"));
  points.forEach((all, i) => {
    const across = new Set(all.split(/[ ;|]/).map(point => point.split(",")[0]));
    if (across.size > 1 && points.indexOf(all) < i) found.push(`panel ${i} is that of ${points.indexOf(all)}`);
  });
  if (svg.matches(".map") && texts.filter(t => /\(\S+\)$/.test(t.words)).length !== 3) found.push("not two axes and a scale with units");
  return found;
}

/** Whether the page begins with its title, the answer, a figure, and only then has tables. */
function ordered() {
  const parts = ["h1", "#answer", "figure", "table"].map(name => all(name).find(e => !e.closest(".alert")));
  return parts.every(Boolean) && parts.every((e, i) => !i || Boolean(parts[i - 1].compareDocumentPosition(e) & Node.DOCUMENT_POSITION_FOLLOWING));
}

const answer = {};
try {
  const style = getComputedStyle(document.body);
  const lights = [light(style.color), light(style.backgroundColor)].sort((a, b) => b - a);
  answer.contrast = lights[0] / lights[1];
  answer.dark = light(style.backgroundColor) < light(style.color);
  answer.loaded = performance.getEntriesByType("resource").length;
  answer.wide = root.scrollWidth > root.clientWidth;
  answer.faults = all("svg.plot, svg.map").flatMap(faults);
  answer.maps = all("svg.map").length;
  answer.ordered = ordered();
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
