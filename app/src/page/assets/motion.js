// Moves a bar over a period: the bar with its obstacle above, the displacement of its tip and the contact force below.
// A pair of bases is chosen from a list; the time is played, set by a slider, or dragged in a diagram.
"use strict";
(() => {
  const element = wavebalance.element;
  const space = "http://www.w3.org/2000/svg";
  const period = 5000;  // milliseconds per period when played
  const { number } = wavebalance;

  function svg(tag, attributes, parent) {
    const made = document.createElementNS(space, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    parent?.append(made);
    return made;
  }

  function text(parent, x, y, content, anchor = "start") {
    svg("text", { x, y, "text-anchor": anchor }, parent).textContent = content;
  }

  // An arrow of a length, its point away from the obstacle and its foot at the tip; nothing for no force.
  function arrow(tip, length) {
    const y = 49, head = Math.min(10, length);
    if (length < 0.5) return "";
    return `M${tip},${y - 3}h${head - length}v-4l${-head},7l${head},7v-4h${length - head}z`;
  }

  // Round numbers between two, at most five.
  function roundValues(low, high) {
    const least = (high - low) / 4, decade = 10 ** Math.floor(Math.log10(least));
    const step = decade * [1, 2, 5, 10].find((factor) => factor * decade >= least * (1 - 1e-9));
    const values = [];
    for (let i = Math.ceil(low / step); i * step <= high; ++i) values.push(i * step + 0);  // no minus zero
    return values;
  }

  // The order in which instants are shown: contact, around t = 0, is in the middle of a diagram.
  function ordered(times) {
    const shown = times.map((time, index) => ({ index, time: time >= 0.5 ? time - 1 : time }));
    return shown.sort((a, b) => a.time - b.time);
  }

  // A diagram over the period; the line of the time that is shown is moved by show().
  class Diagram {
    constructor(data, label, pick, scale, choose) {
      Object.assign(this, { data, label, pick, scale, choose });
      this.svg = svg("svg", { class: "diagram", height: 190 });
      this.svg.addEventListener("pointerdown", (event) => {
        event.preventDefault();  // else dragging selects the texts of the diagram
        this.svg.setPointerCapture(event.pointerId);
        this.drag(event);
      });
      this.svg.addEventListener("pointermove", (event) => { if (event.buttons) this.drag(event); });
    }

    drag(event) {
      const box = this.svg.getBoundingClientRect();
      const share = (event.clientX - box.left - this.left) / (this.width - this.left - 10);
      this.choose(Math.max(0, Math.min(this.data.order.length - 1, Math.round(share * (this.data.order.length - 1)))));
    }

    x(position) { return this.left + (position / (this.data.order.length - 1)) * (this.width - this.left - 10); }
    y(value) { return 156 - ((value - this.low) / (this.high - this.low)) * 136; }

    draw(pair) {
      this.left = 56;
      this.width = Math.max(220, this.svg.parentNode.clientWidth);
      this.svg.setAttribute("width", this.width);
      this.svg.replaceChildren();
      const curves = [this.data.reference, pair].map((motion) => this.pick(motion).map((value) => value * this.scale));
      const every = [this.data.reference, ...this.data.pairs].flatMap((motion) => this.pick(motion)).map((v) => v * this.scale);
      [this.low, this.high] = [Math.min(...every), Math.max(...every)];
      if (this.high === this.low) this.high = this.low + 1;
      for (const value of roundValues(this.low, this.high)) {
        svg("line", { x1: this.left, x2: this.width - 10, y1: this.y(value), y2: this.y(value), class: "grid" }, this.svg);
        text(this.svg, this.left - 6, this.y(value) + 4, number(value, 2), "end");
      }
      text(this.svg, this.left, 12, this.label);
      text(this.svg, this.left, 176, "\u22120.5");
      text(this.svg, (this.left + this.width - 10) / 2, 176, "time (periods)", "middle");
      text(this.svg, this.width - 10, 176, "0.5", "end");
      curves.forEach((curve, which) => {
        const points = this.data.order.map(({ index }, i) => `${this.x(i).toFixed(1)},${this.y(curve[index]).toFixed(1)}`);
        svg("polyline", { points: points.join(" "), class: which ? "line" : "line reference" }, this.svg);
      });
      this.cursor = svg("line", { y1: 18, y2: 158, class: "cursor" }, this.svg);
      this.mark = svg("circle", { r: 4, class: "mark" }, this.svg);
      this.curve = curves[1];
    }

    show(position) {
      const x = this.x(position);
      this.cursor.setAttribute("x1", x);
      this.cursor.setAttribute("x2", x);
      this.mark.setAttribute("cx", x);
      this.mark.setAttribute("cy", this.y(this.curve[this.data.order[position].index]));
    }
  }

  // The bar: displacements are enlarged to make the gap visible.
  class Bar {
    constructor(data) {
      this.data = data;
      this.svg = svg("svg", { class: "bar", height: 124, role: "img", "aria-label": "The bar between its clamp and the obstacle" });
    }

    place(node, displacement) {
      const count = this.data.reference.nodes[0].length - 1;
      return 24 + (node / count) * this.rest + displacement * this.enlarged;
    }

    draw() {
      const width = Math.max(260, this.svg.parentNode.clientWidth);
      const every = [this.data.reference, ...this.data.pairs].flatMap((motion) => motion.tip);
      const [low, high] = [Math.min(...every), Math.max(...every, this.data.gap)];
      this.enlarged = (0.34 * (width - 80)) / (high - low);
      this.rest = width - 60 - high * this.enlarged;
      this.svg.setAttribute("width", width);
      this.svg.replaceChildren();
      svg("rect", { x: 4, y: 14, width: 20, height: 70, class: "wall" }, this.svg);
      const at = this.place(this.data.reference.nodes[0].length - 1, this.data.gap);
      svg("rect", { x: at, y: 14, width: 20, height: 70, class: "wall" }, this.svg);
      svg("line", { x1: at, x2: at, y1: 8, y2: 90, class: "obstacle", "data-gap": this.data.gap }, this.svg);
      const still = this.place(this.data.reference.nodes[0].length - 1, 0);
      svg("line", { x1: still, x2: still, y1: 8, y2: 90, class: "still" }, this.svg);
      text(this.svg, still - 4, 106, "at rest", "end");
      text(this.svg, at + 4, Math.abs(at - still) < 70 ? 119 : 106, "gap", "middle");
      this.body = svg("g", {}, this.svg);
      this.reference = svg("line", { y1: 16, y2: 82, class: "time-stepping" }, this.svg);
      this.tip = svg("line", { y1: 26, y2: 72, class: "tip" }, this.svg);
      this.force = svg("path", { class: "push" }, this.svg);
    }

    show(index, pair) {
      const nodes = pair.nodes[index].map((u, node) => this.place(node, u));
      const tip = nodes[nodes.length - 1];
      this.body.replaceChildren();
      svg("rect", { x: 24, y: 28, width: Math.max(0, tip - 24), height: 42, class: "body" }, this.body);
      for (const x of nodes.slice(1, -1)) svg("line", { x1: x, x2: x, y1: 28, y2: 70, class: "node" }, this.body);
      for (const name of ["x1", "x2"]) this.tip.setAttribute(name, tip);
      const reference = this.place(nodes.length - 1, this.data.reference.tip[index]);
      for (const name of ["x1", "x2"]) this.reference.setAttribute(name, reference);
      const most = Math.max(...this.data.reference.force, 1e-300);
      this.force.setAttribute("d", arrow(tip, Math.max(0, pair.force[index] / most) * 60));
    }
  }

  function build(box, data) {
    data.order = ordered(data.time);
    let position = 0, pair = data.pairs[0] ?? data.reference;
    const list = element("select", { "aria-label": "Pair of bases" },
      ...data.pairs.map((one, i) => element("option", { value: i }, one.label)), element("option", { value: -1 }, data.reference.label));
    list.hidden = data.pairs.length === 0;
    const slider = element("input", { type: "range", min: 0, max: data.order.length - 1, step: 1, value: 0, "aria-label": "Time" });
    const values = element("output", { class: "quiet" });
    const choose = (next) => { position = next; show(); };
    const play = wavebalance.player(period, () => position / data.order.length,
      (place) => choose(Math.floor(place * data.order.length)));
    const set = (next) => { play.pause(); choose(next); };
    const bar = new Bar(data);
    const unit = wavebalance.unitOf(Math.max(...[data.reference, ...data.pairs].flatMap((motion) => motion.tip.map(Math.abs))));
    const diagrams = [
      new Diagram(data, `Displacement of the tip (${unit.name})`, (motion) => motion.tip, unit.factor, set),
      new Diagram(data, "Contact force over the amplitude of the load", (motion) => motion.force, 1, set)];
    const show = () => {
      const { index, time } = data.order[position];
      slider.value = position;
      bar.show(index, pair);
      diagrams.forEach((diagram) => diagram.show(position));
      values.textContent = `t = ${number(time, 3)} T, u = ${number(unit.factor * pair.tip[index])} ${unit.name}, `
        + `force ${number(pair.force[index], 3)}`;
    };
    const draw = () => {
      bar.draw();
      diagrams.forEach((diagram) => diagram.draw(pair));
      show();
    };
    slider.addEventListener("input", () => set(Number(slider.value)));
    list.addEventListener("change", () => { pair = data.pairs[list.value] ?? data.reference; draw(); });
    box.replaceChildren(
      wavebalance.heading(box, `The bar over a period, ${number(data.frequency)} Hz`),
      element("div", { class: "tools" }, list, play.button, slider, values), element("div", {}, bar.svg),
      element("div", { class: "pair" }, ...diagrams.map((diagram) => element("div", {}, diagram.svg))),
      element("p", { class: "quiet" }, (data.pairs.length ? `Grey dashed: ${data.reference.label}. ` : "") + "Displacements are enlarged; the arrow is the contact force. Drag " +
        "in a diagram to set the time."));
    new ResizeObserver(draw).observe(box);
    draw();
  }

  async function start(box) {
    const source = box.dataset.motion;
    await wavebalance.load(source);
    build(box, wavebalance.motions[source.slice(source.lastIndexOf("/") + 1, -".motion.js".length)]);
  }

  document.addEventListener("DOMContentLoaded", () => wavebalance.whenNear(".motion", start));
})();
