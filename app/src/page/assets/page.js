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

document.addEventListener("DOMContentLoaded", () => {
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
