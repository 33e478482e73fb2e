// Curves under each way to form sums over the period: a way is a few choices, and curves and verdicts of the
// statements follow them. Data are in the folder of the figure, whose colours and letters are used.
"use strict";
(() => {
  const element = wavebalance.element;
  const signs = { agrees: "\u2713", differs: "\u2717", "holds in part": "\u00BD", ties: "\u2248" };
  const margin = { top: 8, right: 10, bottom: 36, left: 52 };
  const height = 190;
  const percent = (share) => (share === null ? "no solution found" : `error ${wavebalance.number(100 * share, 3)} %`);

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

  // One fieldset of radio buttons for each choice.
  function fields(data, stem, chosen) {
    return data.choices.map((name, place) => {
      const options = [...new Set(data.readings.map((reading) => reading.choices[place]))].sort((a, b) => a - b || 0);
      return element("fieldset", {}, element("legend", {}, name), ...options.map((option) => {
        const button = element("input", { type: "radio", name: `${stem}-${place}`, value: option });
        button.addEventListener("change", () => chosen(place, option));
        return element("label", {}, button, ` ${option}`);
      }));
    });
  }

  // The way with this option that has most choices in common with the present one; not all combinations were computed.
  function nearest(data, present, place, option) {
    const common = (reading) => reading.choices.filter((one, i) => one === present.choices[i]).length;
    return data.readings.filter((reading) => reading.choices[place] === option)
      .reduce((best, reading) => (common(reading) > common(best) ? reading : best));
  }

  function build(box, data, figure, stem) {
    const panels = ordered(data, figure).map((pair, i) => new Panel(data, pair, String.fromCharCode(97 + i)));
    let reading = data.readings[0];
    const verdicts = element("p", { class: "key" }), name = element("output", {});
    const choices = fields(data, stem, (place, option) => { reading = nearest(data, reading, place, option); show(); });
    const show = () => {
      choices.forEach((field, i) => field.querySelectorAll("input").forEach((one) => { one.checked = one.value === reading.choices[i]; }));
      name.textContent = reading.ofText ? "Allowed by the text of the paper." : "A variant, which decides nothing.";
      verdicts.replaceChildren(...verdictsOf(reading, stem));
      panels.forEach((panel) => panel.show(reading));
    };
    box.replaceChildren(wavebalance.heading(box, "Other sums"), element("div", { class: "tools" }, ...choices, name), verdicts,
      element("div", { class: "sums-panels" }, ...panels.map((panel) => panel.node)),
      element("p", { class: "quiet" }, "Dashed: the exact motion. Errors are relative, rms over the period."));
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
