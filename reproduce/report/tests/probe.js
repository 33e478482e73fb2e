// Opens pages in frames of three widths and writes what it finds as JSON into the element "found". `pages` names them.
"use strict";
const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function until(holds) {
  for (let i = 0; i < 200; ++i) {
    if (holds()) return true;
    await wait(50);
  }
  return false;
}

async function open(page, width) {
  const frame = document.createElement("iframe");
  frame.style = `width:${width}px;height:1000px;border:0;display:block`;
  frame.src = page;
  const loaded = new Promise((resolve) => { frame.onload = resolve; });
  document.body.replaceChildren(frame);
  await loaded;
  await wait(200);
  return frame.contentDocument;
}

const overflow = (page) => page.documentElement.scrollWidth - page.documentElement.clientWidth;

// The elements that reach beyond the right edge and do not scroll within a box of their own.
function tooWide(page) {
  if (overflow(page) <= 0) return [];
  const edge = page.documentElement.clientWidth;
  return [...page.body.querySelectorAll("*")].filter((one) => one.getBoundingClientRect().right > edge + 1 && !one.closest(".wide, svg, .katex"))
    .slice(-3).map((one) => `${one.tagName} ${one.className} ${one.textContent.slice(0, 60)}`);
}

// Everything is unfolded and all curves are drawn.
async function unfold(page) {
  page.querySelectorAll("details").forEach((one) => { one.open = true; });
  const figures = [...page.querySelectorAll("figure[data-curves]")];
  for (const figure of figures) {
    const button = figure.querySelector(".tools button");
    if (button?.getAttribute("aria-pressed") === "false") button.click();
  }
  await until(() => figures.every((figure) => figure.querySelector(".plot .curve, .plot path")));
  return figures.length;
}

function outline(page) {
  const levels = [...page.querySelectorAll("h1,h2,h3,h4")].map((heading) => Number(heading.tagName[1]));
  return { language: page.documentElement.lang, levels,
    withoutAlternative: [...page.images].filter((image) => !image.alt.trim()).map((image) => image.getAttribute("src")),
    mathLeft: page.defaultView.katex ? [...page.querySelectorAll(".math")].filter((one) => !one.querySelector(".katex")).length : 0 };
}

// The tip of the bar at three instants, from where it is drawn between its place at rest and the obstacle.
async function tips(page) {
  const box = page.querySelector(".motion");
  if (!box) return null;
  const view = page.defaultView;
  // Frames are not drawn here, so that what a browser does with each of them is done by the clock.
  view.requestAnimationFrame = (step) => view.setTimeout(() => step(view.performance.now()), 16);
  box.scrollIntoView();
  view.dispatchEvent(new view.Event("scroll"));
  if (!(await until(() => box.querySelector("select")))) return "no motion was drawn";
  const at = (name) => Number(box.querySelector(name).getAttribute("x1"));
  const found = [];
  const [list, slider] = [box.querySelector("select"), box.querySelector("input")];
  for (const pair of [0, 1, -1])
    for (const share of [0.1, 0.5, 0.8]) {
      list.value = pair;
      list.dispatchEvent(new view.Event("change"));
      slider.value = Math.round(share * slider.max);
      slider.dispatchEvent(new view.Event("input"));
      const gap = Number(box.querySelector(".obstacle").dataset.gap);
      found.push({ pair, position: Number(slider.value),
        tip: (gap * (at(".tip") - at(".still"))) / (at(".obstacle") - at(".still")),
        text: box.querySelector("output").textContent });
    }
  const play = box.querySelector("button"), before = slider.value;
  play.click();
  const moved = await until(() => slider.value !== before);
  play.click();
  return { source: box.dataset.motion, found, moved };
}

// The slider over ways to form sums at its ends: names, titles and curves of the panels, and the verdicts.
async function sums(page) {
  const box = page.querySelector(".sums");
  if (!box || !page.defaultView.d3) return null;
  box.scrollIntoView();
  page.defaultView.dispatchEvent(new page.defaultView.Event("scroll"));
  if (!(await until(() => box.querySelector(".curve")))) return "no curves were drawn";
  const slider = box.querySelector("input"), found = [];
  for (const value of [0, slider.max]) {
    slider.value = value;
    slider.dispatchEvent(new page.defaultView.Event("input"));
    found.push({ name: box.querySelector("output").textContent,
      titles: [...box.querySelectorAll(".panel > p")].map((one) => one.textContent),
      verdicts: [...box.querySelectorAll(".key a")].map((one) => `${one.getAttribute("href")} ${one.textContent}`),
      curves: [...box.querySelectorAll(".panel")].map((one) => [...one.querySelectorAll(".curve")].pop().getAttribute("d")) });
  }
  return found;
}

// What is read ten pixels beside the first point of the last curve of the second panel, whose points have symbols.
function snapped(view, figure) {
  const panel = figure.querySelectorAll(".plot")[1], path = [...(panel?.querySelectorAll(".curve") ?? [])].pop();
  if (!path) return null;
  const svg = panel.querySelector("svg"), box = svg.getBoundingClientRect();
  const place = svg.querySelector("g").getAttribute("transform").match(/[\d.]+/g).map(Number);
  const [a, b] = path.getAttribute("d").slice(1).split("L").map((point) => point.split(",").map(Number));
  if (!b) return null;
  const share = 10 / Math.hypot(b[0] - a[0], b[1] - a[1]);
  svg.dispatchEvent(new view.PointerEvent("pointermove", { clientX: box.left + place[0] + a[0] + share * (b[0] - a[0]),
    clientY: box.top + place[1] + a[1] + share * (b[1] - a[1]) }));
  return panel.querySelector(".values").textContent;
}

// The first curve of a figure: values at its points, hidden by its name, zoomed by keys and put back.
async function curves(page) {
  const figure = page.querySelector("figure[data-curves]");
  if (!figure || !page.defaultView.d3) return null;
  const view = page.defaultView, svg = figure.querySelector(".plot svg"), box = svg.getBoundingClientRect();
  const name = figure.dataset.curves.replace(/^.*\//, "").replace(".figure.js", "");
  const data = view.wavebalance.figures[name].panels[0], series = data.series[0];
  const path = svg.querySelector(".curve").getAttribute("d"), middle = Math.floor(series.x.length / 2);
  const points = path.slice(1).split(/[ML]/).map((point) => point.split(",").map(Number));
  const place = svg.querySelector("g").getAttribute("transform").match(/[\d.]+/g).map(Number);
  svg.dispatchEvent(new view.PointerEvent("pointermove",
    { clientX: box.left + place[0] + points[middle][0], clientY: box.top + place[1] + points[middle][1] }));
  const values = figure.querySelector(".values").textContent;
  const count = () => figure.querySelectorAll(".plot .curve").length, before = count();
  const entry = figure.querySelector(".legend button");
  entry?.click();
  const hidden = count();
  entry?.click();
  const press = (key) => svg.dispatchEvent(new view.KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
  const now = () => svg.querySelector(".curve").getAttribute("d");
  press("+");
  const zoomed = now() !== path;
  press("0");
  const wheel = (ctrlKey) => {
    svg.dispatchEvent(new view.WheelEvent("wheel", { deltaY: -200, ctrlKey, bubbles: true, cancelable: true,
      clientX: box.left + 100, clientY: box.top + 60 }));
    const changed = now() !== path;
    press("0");
    return changed;
  };
  return { wheel: wheel(false), wheelWithCtrl: wheel(true), snapped: snapped(view, figure), values, x: series.x[middle], y: series.y[middle], label: series.label, before, hidden, zoomed, reset: now() === path };
}

(async () => {
  const found = [];
  try {
    for (const page of pages)
      for (const width of [400, 800, 1400]) {
        const opened = await open(page, width);
        const one = { page, width, ...outline(opened), folded: overflow(opened) };
        if (width === 1400) one.tips = await tips(opened);
        if (width === 1400) one.sums = await sums(opened);
        one.figures = await unfold(opened);
        one.unfolded = overflow(opened);
        one.tooWide = tooWide(opened);
        if (width === 1400) one.curves = await curves(opened);
        found.push(one);
      }
    document.body.replaceChildren();
  } catch (error) {
    found.push({ error: String(error) });
  }
  const pre = document.createElement("pre");
  pre.id = "found";
  pre.textContent = JSON.stringify(found);
  document.body.replaceChildren(pre);
})();
