// Sets formulas, opens the contents where there is room for them, and loads scripts of data when they are needed.
"use strict";
window.wavebalance ??= {};

// Resolves when the script at `source` has run; each is loaded once.
wavebalance.load = (source) => {
  const loaded = (wavebalance.loaded ??= {});
  loaded[source] ??= new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = source;
    script.onload = resolve;
    script.onerror = () => reject(new Error(`${source} could not be loaded`));
    document.head.append(script);
  });
  return loaded[source];
};

// An element with attributes and children, which are elements or texts.
wavebalance.element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

// A power of ten as text with raised digits.
wavebalance.power = (exponent) => {
  const raised = "\u2070\u00B9\u00B2\u00B3\u2074\u2075\u2076\u2077\u2078\u2079";
  return "10" + [...String(exponent)].map((c) => (c === "-" ? "\u207B" : raised[c])).join("");
};

// A number for readers in the format of short_number() (app/files): with powers of ten below 1e-3 and from 1e5 on.
wavebalance.number = (value, digits = 4) => {
  if (value === null || !Number.isFinite(value)) return "not known";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e").map(Number);
  const plain = value === 0 || (exponent >= -3 && exponent < Math.max(digits, 5));
  const text = plain ? String(Number(value.toPrecision(digits)))
    : `${mantissa}\u00B7${wavebalance.power(exponent)}`.replace(/^(-?)1\u00B7/, "$1");
  return text.replace("-", "\u2212");
};

// The unit of lengths up to `largest` metres, and the factor on them.
wavebalance.unitOf = (largest) => {
  const units = [["m", 1], ["mm", 1e3], ["\u00B5m", 1e6], ["nm", 1e9], ["pm", 1e12]];
  const [name, factor] = units.find(([, size]) => largest * size >= 1) ?? units[1];
  return { name, factor };
};

// A heading for what a script draws in `box`, one level below the heading before it and at most of the fourth.
wavebalance.heading = (box, text) => {
  const before = [...document.querySelectorAll("h1, h2, h3, h4")]
    .filter((one) => one.compareDocumentPosition(box) === Node.DOCUMENT_POSITION_FOLLOWING).pop();
  return wavebalance.element(`h${Math.min(4, Number(before?.tagName[1] ?? 0) + 1)}`, {}, text);
};

// A button that plays periods of so many milliseconds: in each frame `show` gets the place in the period, 0 <= place <
// 1, from `place()` on. The clock is that of the frames, whose first may be before the click.
wavebalance.player = (period, place, show) => {
  const button = wavebalance.element("button", { type: "button", "aria-pressed": "false" }, "Play");
  let frame = null, started = null;
  const step = (now) => {
    started ??= now - place() * period;
    show(((now - started) / period) % 1);
    frame = requestAnimationFrame(step);
  };
  const run = (on) => {
    cancelAnimationFrame(frame);
    started = null;
    frame = on ? requestAnimationFrame(step) : null;
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(on));
  };
  button.addEventListener("click", () => run(frame === null));
  return { button, pause: () => run(false) };
};

// Calls `start` with each element that `selector` finds when it comes near the window.
wavebalance.whenNear = (selector, start) => {
  let waiting = [...document.querySelectorAll(selector)];
  waiting.forEach((box) => box.classList.add("waiting"));
  const near = (box) => {
    const { top, bottom } = box.getBoundingClientRect();
    return bottom > -300 && top < window.innerHeight + 300;
  };
  const check = () => {
    const found = waiting.filter(near);
    waiting = waiting.filter((box) => !found.includes(box));
    found.forEach(start);
  };
  for (const event of ["scroll", "resize"]) window.addEventListener(event, check, { passive: true });
  check();
};

// Folded parts are printed too, except those that repeat other parts of the page or do not decide.
{
  let opened = [];
  window.addEventListener("beforeprint", () => {
    document.querySelectorAll("img[loading]").forEach((image) => { image.loading = "eager"; });
    opened = [...document.querySelectorAll("main details:not([open], .table-of-values, .origin, .checks, .readings, #brief > *)")];
    opened.forEach((one) => { one.open = true; });
  });
  window.addEventListener("afterprint", () => opened.forEach((one) => { one.open = false; }));
}

// On narrow screens a picture is shown at three quarters of its size at least, so that its letters have 10 px; it scrolls.
function keepReadable(image) {
  const narrow = window.matchMedia("(max-width: 700px)");
  const share = image.src.endsWith(".png") ? 0.375 : 0.75;  // pictures of pixels have twice as many
  const fit = () => { image.style.minWidth = narrow.matches && image.naturalWidth ? `${share * image.naturalWidth}px` : ""; };
  narrow.addEventListener("change", fit);
  image.addEventListener("load", fit);
  fit();
}

// No line breaks a number from its error and its unit.
wavebalance.keepTogether = (box) => {
  const unit = "(?:[GMkm\u00B5np]?(?:Hz|N|J|m|s)(?:/s)?|%)(?![\\p{L}\\d])";
  const quantity = new RegExp(`(-?[\\d.]*\\d(?:\u00B710[\u207B\u2070\u00B9\u00B2\u00B3\u2074-\u2079]+)?(?: \u00B1 [\\d.]+(?: ${unit})?| ${unit}))`, "u");
  const outside = ({ parentElement: one }) => one.closest(".math, script, style, pre, svg") ? NodeFilter.FILTER_REJECT : NodeFilter.FILTER_ACCEPT;
  const texts = document.createTreeWalker(box, NodeFilter.SHOW_TEXT, outside), found = [];
  while (texts.nextNode()) if (quantity.test(texts.currentNode.textContent)) found.push(texts.currentNode);
  for (const text of found)
    text.replaceWith(...text.textContent.split(quantity).map((part, i) => (i % 2 ? wavebalance.element("span", { class: "whole" }, part) : part)));
};

document.addEventListener("DOMContentLoaded", () => {
  document.querySelectorAll(".picture img").forEach(keepReadable);
  document.querySelectorAll("main").forEach(wavebalance.keepTogether);
  const measured = new ResizeObserver((found) => {
    for (const { target } of found) target.style.setProperty("--height", `${target.offsetHeight}px`);
  });
  document.querySelectorAll(".beside > .shown").forEach((one) => measured.observe(one));
  if (window.katex)
    for (const formula of document.querySelectorAll(".math"))
      katex.render(formula.textContent, formula, { throwOnError: false });
  const contents = document.querySelector(".contents > details");
  if (!contents) return;
  const wide = window.matchMedia("(min-width: 1000px)");
  const fit = () => { contents.open = wide.matches; };
  wide.addEventListener("change", fit);
  fit();
  contents.addEventListener("click", (event) => {
    if (!wide.matches && event.target.closest("a")) contents.open = false;
  });
});
