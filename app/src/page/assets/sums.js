// Curves under one way after another to form sums over the period: a slider chooses the way, the curves and the verdicts
// of the statements follow. Data are left beside the figure, whose colours and letters are taken.
"use strict";
(() => {
  const element = wavebalance.element;
  const signs = { agrees: "\u2713", differs: "\u2717", "holds in part": "\u00BD", ties: "\u2248" };
  const margin = { top: 8, right: 10, bottom: 36, left: 52 };
  const height = 190;
  const percent = (share) => (share === null ? "no solution found" : `error ${Number((100 * share).toPrecision(3))} %`);

  // The pairs in the order of the panels of the figure, with its colours.
  function ordered(data, figure) {
    const found = [];
    const left = (series) => data.pairs.some((pair) => pair.label === series.label) && !found.some((one) => one.label === series.label);
    for (const panel of figure.panels) {
      const series = panel.series.find(left);
      if (!series) continue;
      const index = data.pairs.findIndex((pair) => pair.label === series.label);
      found.push({ index, label: series.label, colour: series.colour, steps: data.pairs[index].steps });
    }
    return found;
  }

  // The range of a curve, over all ways, of the pairs with jumps or of the others.
  function rangeOf(data, steps) {
    let [low, high] = d3.extent(data.reference);
    for (const reading of data.readings)
      reading.curves.forEach((curve, i) => {
        if (!curve || data.pairs[i].steps !== steps) return;
        low = Math.min(low, d3.min(curve));
        high = Math.max(high, d3.max(curve));
      });
    return [low * data.unit, high * data.unit];
  }

  class Panel {
    constructor(data, pair, letter) {
      Object.assign(this, { data, pair });
      this.head = element("p", {});
      this.title = `(${letter}) ${pair.label}`;
      this.svg = d3.create("svg").attr("height", height).attr("role", "img");
      this.node = element("div", { class: "panel" }, this.head, element("div", { class: "plot" }, this.svg.node()));
    }

    size() {
      const width = Math.max(200, this.node.clientWidth), { data } = this;
      this.x = d3.scaleLinear([data.from, data.to], [margin.left, width - margin.right]);
      this.y = d3.scaleLinear(rangeOf(data, this.pair.steps), [height - margin.bottom, margin.top]).nice(4);
      this.svg.attr("width", width).selectAll("*").remove();
      const axis = () => this.svg.append("g").attr("class", "axis");
      axis().attr("transform", `translate(0,${height - margin.bottom})`).call(d3.axisBottom(this.x).ticks(width / 90));
      axis().attr("transform", `translate(${margin.left},0)`).call(d3.axisLeft(this.y).ticks(4).tickSizeInner(margin.left + margin.right - width).tickPadding(6));
      const label = (x, y, text) => this.svg.append("text").attr("x", x).attr("y", y).attr("text-anchor", "middle").text(text);
      label((margin.left + width) / 2, height - 4, "Normalised time t/T");
      label(0, 0, data.label).attr("transform", `translate(11,${(height - margin.bottom + margin.top) / 2})rotate(-90)`);
      if (data.level !== null)
        this.svg.append("line").attr("x1", margin.left).attr("x2", width - margin.right).attr("y1", this.y(data.level))
          .attr("y2", this.y(data.level)).attr("stroke", "#999");
      this.path(data.reference).attr("stroke", "#000").attr("stroke-dasharray", "6 4").attr("stroke-width", 1.2);
      this.curve = this.path(null).attr("stroke", this.pair.colour).attr("stroke-width", 1.8);
    }

    points(values) {
      const last = values.length - 1, span = this.data.to - this.data.from;
      const line = d3.line().x((_, i) => this.x(this.data.from + (span * i) / last)).y((value) => this.y(value * this.data.unit));
      return (this.pair.steps && values !== this.data.reference ? line.curve(d3.curveStepAfter) : line)(values);
    }

    path(values) { return this.svg.append("path").attr("class", "curve").attr("d", values ? this.points(values) : null); }

    show(reading) {
      const values = reading.curves[this.pair.index];
      this.curve.attr("d", values ? this.points(values) : null);
      const error = percent(reading.errors[this.pair.index]);
      this.head.replaceChildren(element("b", {}, this.title), `, ${error}`);
      this.svg.attr("aria-label", `${this.title}: ${this.data.label} over time, ${error}`);
    }
  }

  function verdictsOf(reading, stem) {
    return reading.verdicts.map(({ statement, verdict }) =>
      element("a", { class: `badge ${verdict === "holds in part" || verdict === "ties" ? "partly" : verdict}`, href: `#${stem}-${statement}` },
        `statement ${statement}: ${signs[verdict] ?? ""} ${verdict}`));
  }

  function build(box, data, figure, stem) {
    const panels = ordered(data, figure).map((pair, i) => new Panel(data, pair, String.fromCharCode(97 + i)));
    const last = data.readings.length - 1;
    const slider = element("input", { type: "range", min: 0, max: last, step: 1, value: 0, "aria-label": "Way to form the sums" });
    const name = element("output", {}), verdicts = element("p", { class: "key" });
    const grid = element("div", { class: "sums-panels" }, ...panels.map((panel) => panel.node));
    const show = () => {
      const reading = data.readings[slider.value];
      name.replaceChildren(element("b", {}, `${Number(slider.value) + 1} of ${last + 1}: ${reading.name}`),
        reading.ofText ? (Number(slider.value) === 0 ? ". The text allows it; the figure shows it." : ". The text allows it.")
          : ". This is not what the paper does.");
      slider.setAttribute("aria-valuetext", reading.name);
      verdicts.replaceChildren(...verdictsOf(reading, stem));
      panels.forEach((panel) => panel.show(reading));
    };
    slider.addEventListener("input", show);
    box.replaceChildren(wavebalance.heading(box, "Form the sums otherwise"), element("div", { class: "tools" }, slider, name), verdicts, grid,
      element("p", { class: "quiet" }, "Black and dashed: the exact motion. Errors are those of the whole period, rms over the rms of the exact one. " +
        "The first two ways are those that the text allows; the verdicts of the statements rest on them alone."));
    const draw = () => { panels.forEach((panel) => panel.size()); show(); };
    new ResizeObserver(draw).observe(box);
    draw();
  }

  async function start(box) {
    const source = box.dataset.readings;
    const stem = source.slice(source.lastIndexOf("/") + 1, -".readings.js".length);
    await Promise.all([wavebalance.load(source), wavebalance.load(source.replace(/readings\.js$/, "figure.js"))]);
    build(box, wavebalance.readings[stem], wavebalance.figures[stem], stem);
  }

  document.addEventListener("DOMContentLoaded", () => { if (window.d3) wavebalance.whenNear(".sums", start); });
})();
