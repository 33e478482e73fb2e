// The measures in px of an SVG picture of gnuplot, as chromium draws it.
"use strict";

// The middle of a text's box: letters fill 0.6 of the height of a line.
function boxOf(text) {
  const box = text.getBoundingClientRect(), [wide, high] = [box.width, box.height];
  const turned = high > wide && text.textContent.length > 2;  // labels of ordinates
  const [x, y] = turned ? [0.2 * wide, 0] : [0, 0.2 * high];
  return { text: text.textContent, legend: Boolean(text.closest("[id^=gnuplot_plot_]")), left: box.left + x, right: box.right - x,
    top: box.top + y, bottom: box.bottom - y };
}

// Vertices of the lines of a path, which gnuplot writes as absolute M and L.
function linesOf(path) {
  const lines = [];
  let last = null;
  for (const [, command, x, y] of path.getAttribute("d").matchAll(/([ML])?\s*(-?[\d.]+)\s*,\s*(-?[\d.]+)/g)) {
    const next = [Number(x), Number(y)];
    if (command !== "M" && last) lines.push([last, next]);
    last = next;
  }
  return lines;
}

// Whether the line from a to b passes through the box, by Liang and Barsky (1984).
function meets([a, b], box) {
  const d = [b[0] - a[0], b[1] - a[1]];
  let [from, to] = [0, 1];
  for (const [p, q] of [[-d[0], a[0] - box.left], [d[0], box.right - a[0]], [-d[1], a[1] - box.top], [d[1], box.bottom - a[1]]]) {
    if (p === 0 && q < 0) return false;
    if (p < 0) from = Math.max(from, q / p);
    if (p > 0) to = Math.min(to, q / p);
  }
  return from <= to;
}

// The axes of a panel are one path of its left and lower edge. gnuplot draws them in no other colour.
function areasOf(paths) {
  const areas = paths.filter((path) => path.getAttribute("stroke") === "rgb( 34,  34,  34)").map(linesOf)
    .filter((lines) => lines.length === 2 && lines[0][0][0] === lines[0][1][0] && lines[1][0][1] === lines[1][1][1]);
  return areas.map(([up, along]) => ({ left: up[0][0], right: along[1][0], top: Math.min(up[0][1], up[1][1]), bottom: along[0][1] }));
}

// Number of labels below the axes and left of them.
function numbersOf(area, texts) {
  const within = (value, from, to) => value > from && value < to;
  const number = /^[\u2212-]?[\d.]+(\u00B710)?([\u2212-]?\d+)?$/;
  const [across, up] = [["left", "right"], ["top", "bottom"]].map((edges) => (box) => (box[edges[0]] + box[edges[1]]) / 2);
  const numbers = texts.filter((box) => number.test(box.text.trim()));
  return [numbers.filter((box) => within(across(box), area.left - 5, area.right + 5) && within(up(box), area.bottom, area.bottom + 35)).length,
    numbers.filter((box) => within(up(box), area.top - 8, area.bottom + 8) && within(across(box), area.left - 70, area.left)).length];
}

function measured(svg, least) {
  const paths = [...svg.querySelectorAll("#gnuplot_canvas path:not(.gridline)")].filter((path) => !path.closest("defs"));
  const texts = [...svg.querySelectorAll("text")].filter((text) => text.textContent.trim()).map(boxOf);
  const [width, height] = ["width", "height"].map((name) => Number(svg.getAttribute(name)));
  const overlap = (a, b) => a.left < b.right + 2 && b.left < a.right + 2 && a.top < b.bottom && b.top < a.bottom;
  const marks = [...svg.querySelectorAll("use")].filter((mark) => !mark.closest("defs"))
    .map((mark) => mark.getAttribute("transform").match(/-?[\d.]+/g).map(Number));
  const lines = paths.flatMap(linesOf);
  const on = (box) => lines.filter((line) => meets(line, box)).length +
    marks.filter(([x, y]) => x > box.left - 3 && x < box.right + 3 && y > box.top - 3 && y < box.bottom + 3).length;
  const areas = areasOf(paths);
  return { width, height, areas, unlabelled: areas.filter((area) => numbersOf(area, texts).some((count) => count < least)).length, texts: texts.length,
    legend: texts.filter((box) => box.legend).length,
    overlapping: texts.flatMap((a, i) => texts.slice(i + 1).filter((b) => overlap(a, b)).map((b) => [a.text, b.text])),
    cut: texts.filter((box) => box.left < -0.5 || box.top < -0.5 || box.right > width + 0.5 || box.bottom > height + 0.5).map((box) => box.text),
    covered: texts.filter((box) => box.legend && on(box) > 0).map((box) => [box.text, on(box)]) };
}
