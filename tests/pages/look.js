// Functions of tests for an open page: `look`, defined in it once.
"use strict";
window.look ??= (() => {
  const root = document.documentElement;
  const overflow = () => root.scrollWidth - root.clientWidth;
  const frame = () => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));

  // Elements that reach beyond the right edge and do not scroll within a box.
  const tooWide = () => (overflow() <= 0 ? [] : [...document.body.querySelectorAll("*")]
    .filter((one) => one.getBoundingClientRect().right > root.clientWidth + 1 && !one.closest(".wide, svg, .katex"))
    .slice(-3).map((one) => `${one.tagName} ${one.className} ${one.textContent.slice(0, 60)}`));

  // Everything is unfolded, and the curves of all figures are drawn instead of their pictures, or the pictures again.
  async function draw(curves) {
    document.querySelectorAll("details").forEach((one) => { one.open = true; });
    for (const button of document.querySelectorAll("figure[data-curves] .tools button[aria-pressed]"))
      if ((button.getAttribute("aria-pressed") === "true") !== curves) button.click();
    const drawn = () => [...document.querySelectorAll("figure[data-curves]")].every((one) => one.querySelector(".plot path"));
    for (let i = 0; curves && window.d3 && !drawn() && i < 400; ++i) await new Promise((resolve) => setTimeout(resolve, 20));
    await frame();
  }

  function outline() {
    const pictures = [...document.images];
    return { language: root.lang, levels: [...document.querySelectorAll("h1,h2,h3,h4")].map((one) => Number(one.tagName[1])),
      withoutWords: pictures.filter((one) => !one.alt.trim()).map((one) => one.src),
      withoutRoom: pictures.filter((one) => one.closest(".picture") && !(one.getAttribute("width") > 0 && one.getAttribute("height") > 0)).map((one) => one.src),
      formulasLeft: window.katex ? [...document.querySelectorAll(".math")].filter((one) => !one.querySelector(".katex")).length : 0,
      scrollInside: [...document.querySelectorAll(".shown")].filter((one) => one.scrollHeight > one.clientHeight + 1).length };
  }

  // Titles of axes that the edge of their plot cuts, and legends that cannot be distinguished from the page.
  const brightness = (colour) => colour.match(/[\d.]+/g).slice(0, 3).reduce((sum, one) => sum + Number(one), 0) / 3;
  function ground(one) {
    for (let at = one; at; at = at.parentElement) {
      const colour = getComputedStyle(at).backgroundColor;
      if (!/, 0\)$|transparent/.test(colour)) return brightness(colour);
    }
    return 255;
  }
  const overlap = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 4 && b.top < a.bottom - 4;
  function unreadable() {
    // Keys of lists, numbers, quantities and options of commands that are broken, and panels with a letter and no title.
    const lines = (one) => { const range = document.createRange(); range.selectNodeContents(one); return range.getClientRects().length; };
    const broken = [...document.querySelectorAll("dt")].filter((one) => !one.textContent.includes(" ") && lines(one) > 1);
    const torn = [...document.querySelectorAll("td")].filter((one) => one.textContent && Number.isFinite(Number(one.textContent)) && lines(one) > 1);
    const whole = (selector, pattern) => [...document.querySelectorAll(selector)].flatMap((one) => {
      const found = [], nodes = document.createTreeWalker(one, NodeFilter.SHOW_TEXT);
      for (let node = nodes.nextNode(); node; node = nodes.nextNode())
        for (const { index, 0: word } of node.textContent.matchAll(pattern)) {
          const range = document.createRange();
          range.setStart(node, index);
          range.setEnd(node, index + word.length);
          if (range.getClientRects().length > 1) found.push({ textContent: word });
        }
      return found;
    });
    const options = [...whole("pre code, td", /--[a-z-]+/g), ...whole("main :is(p, li, dd, td)", /\d (?:± [\d.]+|[GMkmµn]?(?:Hz|N|J|m|s)\b|%)/g)];
    const halved = [...document.querySelectorAll(".plot [clip-path] path:not(.curve)")].map(() => ({ textContent: "a symbol that an edge cuts" }));
    const untitled = [...document.querySelectorAll(".panel > p")].filter((one) => /^\([a-z]\)\s*$/.test(one.textContent));
    const cut = [...document.querySelectorAll(".plot .label, .plot .tick text, .motion text")].filter((one) => one.textContent).filter((one) => {
      const label = one.getBoundingClientRect(), box = one.closest("svg").getBoundingClientRect();
      return label.top < box.top - 1 || label.bottom > box.bottom + 1 || label.left < box.left - 1 || label.right > box.right + 1;
    });
    const raw = [...document.querySelectorAll(".plot text")].filter((one) => /[\^_]\{/.test(one.textContent));
    const words = [...document.querySelectorAll(".motion text")].map((one) => ({ one, box: one.getBoundingClientRect() }));
    const upon = words.filter(({ one, box }, i) => words.slice(i + 1).some((other) => other.one.parentNode === one.parentNode && overlap(box, other.box)))
      .map(({ one }) => one);
    const faint = [...document.querySelectorAll(".legend button")].filter((one) => {
      const strokes = [...one.querySelectorAll("[stroke]")].map((mark) => brightness(getComputedStyle(mark).stroke));
      return [brightness(getComputedStyle(one).color), ...strokes].some((shade) => Math.abs(shade - ground(one)) < 45);
    });
    const crowded = [...document.querySelectorAll(".plot .axis")].flatMap((axis) => {
      const numbers = [...axis.querySelectorAll(".tick text:not([visibility])")].filter((one) => one.textContent).map((one) => ({ one, box: one.getBoundingClientRect() }));
      return numbers.filter(({ box }, i) => i > 0 && overlap(box, numbers[i - 1].box)).map(({ one }) => one);
    });
    return [...crowded, ...cut, ...halved, ...raw, ...upon, ...faint, ...broken, ...torn, ...options, ...untitled].map((one) => one.textContent);
  }

  // Names of legends whose button hides nothing, or whose second click does not bring it back.
  function idle() {
    return [...document.querySelectorAll(".legend button")].filter((one) => {
      const plots = () => [...one.closest(".curves").querySelectorAll(".curve[d], .plot path:not(.curve), .plot rect")]
        .map((mark) => mark.outerHTML).join();
      const before = plots();
      one.click();
      const hidden = plots();
      one.click();
      return hidden === before || plots() !== before;
    }).map((one) => one.textContent);
  }

  // Pixels of the canvas that are not ground, and a number that differs where they do, with the body at a place of its period.
  function body(box, place) {
    const slider = box.querySelector("input"), canvas = box.querySelector("canvas");
    slider.value = place;
    slider.dispatchEvent(new Event("input"));
    const gl = canvas.getContext("webgl2") ?? canvas.getContext("webgl");
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let ink = 0, sum = 0;
    for (let i = 0; i < pixels.length; i += 4)
      if (pixels[i] < 250) { ++ink; sum = (31 * sum + i + pixels[i]) % 1000003; }
    return { ink, sum, all: pixels.length / 4, time: box.querySelector("output").textContent };
  }

  return { overflow, tooWide, draw, outline, unreadable, idle, body };
})();
