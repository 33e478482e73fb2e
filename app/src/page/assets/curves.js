// Draws the curves of a figure instead of its picture: they zoom, show values under the pointer, and can be hidden.
// Data come from figure_script() of app/plot; d3 draws scales, axes and zooms.
"use strict";
(() => {
  const margin = { top: 8, right: 24, bottom: 48, left: 66 };
  const reach = 40;  // pixels within which a curve answers to the pointer
  const element = wavebalance.element;
  // Symbols as in the pictures: five filled ones, then three open ones.
  const downwards = { draw(context, size) {
    const y = -Math.sqrt(size / (Math.sqrt(3) * 3));
    context.moveTo(0, -2 * y);
    context.lineTo(-Math.sqrt(3) * y, y);
    context.lineTo(Math.sqrt(3) * y, y);
    context.closePath();
  } };
  const symbols = () => [d3.symbolCircle, d3.symbolSquare, d3.symbolTriangle, d3.symbolDiamond, downwards,
                         d3.symbolCircle, d3.symbolSquare, d3.symbolTriangle];
  const number = (value) => wavebalance.number(value, 5);

  // A power of ten as such; nothing for other values.
  const power = (value) => {
    const exponent = Math.round(Math.log10(value));
    return Math.abs(value / 10 ** exponent - 1) > 1e-9 ? "" : wavebalance.power(exponent);
  };

  // A text given for a tick, in which powers of ten are marked as gnuplot has them; a tick holds no parts.
  const tickText = (text) => text?.replace(/10\^\{?(-?\d+)\}?/g, (_, exponent) => power(10 ** exponent));

  // gnuplot's enhanced text as parts {text, level, bold, italic}; level 1 is raised and -1 lowered.
  function parts(text, style = { level: 0, bold: false, italic: false }) {
    const found = [];
    let plain = "";
    const flush = () => { if (plain) found.push({ ...style, text: plain }); plain = ""; };
    for (let i = 0; i < text.length; ++i) {
      const c = text[i];
      if (c === "\\" && i + 1 < text.length) { plain += text[++i]; continue; }
      if (c !== "_" && c !== "^" && c !== "{") { plain += c; continue; }
      flush();
      const level = c === "_" ? -1 : c === "^" ? 1 : style.level;
      if (c !== "{") ++i;
      if (text[i] !== "{") { found.push({ ...style, level, text: text[i] ?? "" }); continue; }
      let end = i + 1;
      for (let depth = 1; end < text.length; ++end) {
        depth += text[end] === "{" ? 1 : text[end] === "}" ? -1 : 0;
        if (depth === 0) break;
      }
      const inside = text.slice(i + 1, end), face = /^\/:?(Bold|Italic|[A-Za-z]+)? ?/.exec(inside);
      found.push(...parts(face ? inside.slice(face[0].length) : inside,
                          { level, bold: style.bold || face?.[1] === "Bold",
                            italic: style.italic || face?.[1] === "Italic" }));
      i = end;
    }
    flush();
    return found;
  }

  function html(text) {
    return parts(text).map((part) => {
      let node = document.createTextNode(part.text);
      if (part.italic) node = element("i", {}, node);
      if (part.bold) node = element("b", {}, node);
      return part.level ? element(part.level > 0 ? "sup" : "sub", {}, node) : node;
    });
  }

  function svgText(selection, text) {
    let level = 0;
    for (const part of parts(text)) {
      selection.append("tspan").text(part.text).attr("dy", `${(level - part.level) * 0.35}em`)
        .attr("font-size", part.level ? "75%" : null).attr("font-style", part.italic ? "italic" : null)
        .attr("font-weight", part.bold ? "bold" : null);
      level = part.level;
    }
  }

  // The texts of ticks: those chosen for the picture as it has them, else numbers of one kind along an axis.
  function tickFormat(axis, scale, count, chosen) {
    const [low, high] = scale.domain(), decimals = /^%\.(\d)f$/.exec(axis.format)?.[1];
    const decades = axis.logarithmic && high >= 1000 * low;
    if (chosen)
      return (value, i) => tickText(axis.texts[i]) || (decimals ? value.toFixed(decimals) : (decades && power(value)) || number(value));
    return axis.logarithmic ? scale.tickFormat(count, decades ? power : number) : scale.tickFormat(count);
  }

  // The title of an axis in one line, or in two where it is longer than the axis; `at` places the i-th of n.
  function title(parent, text, room, at) {
    const add = (part, i, n) => {
      const made = parent.append("text").attr("class", "label").attr("text-anchor", "middle").attr("transform", at(i, n));
      svgText(made, part);
      return made;
    };
    const whole = add(text, 0, 1);
    if (whole.node().getComputedTextLength() <= room) return;
    const blanks = [...text.matchAll(/ (?![^{]*})/g)].map((found) => found.index);
    if (blanks.length === 0) return;
    const middle = blanks.reduce((a, b) => (Math.abs(b - text.length / 2) < Math.abs(a - text.length / 2) ? b : a));
    whole.remove();
    [text.slice(0, middle), text.slice(middle + 1)].forEach((part, i) => {
      const made = add(part, i, 2), excess = made.node().getComputedTextLength() / room;
      if (excess > 1) made.attr("font-size", `${Math.max(60, 100 / excess)}%`);
    });
  }

  const mark = (parent, series, x, y) => parent.append("path").attr("transform", `translate(${x},${y})`)
    .attr("d", d3.symbol().size(36 * (series.size ?? 1) ** 2).type(symbols()[series.marker % 8])())
    .attr("fill", series.marker % 8 > 4 ? "white" : series.colour).attr("stroke", series.colour);

  const finite = (scale, value) => value !== null && Number.isFinite(scale(value));

  // In a map the cells show their values, not the marks on them.
  const telling = (list) => (list.some((series) => series.cells) ? list.filter((series) => series.cells) : list);

  function scaleOf(axis, values, range, round) {
    const scale = axis.logarithmic ? d3.scaleLog() : d3.scaleLinear();
    const usable = values.filter((v) => v !== null && (!axis.logarithmic || v > 0));
    let [lower, upper] = usable.length ? d3.extent(usable) : axis.logarithmic ? [0.1, 1] : [0, 1];
    if (lower === upper) { const step = Math.abs(lower) * 0.1 || 1; lower -= step; upper += step; }
    scale.domain([lower, upper]).range(range);
    if (round) scale.nice();
    const chosen = scale.domain();
    return scale.domain([axis.lower ?? chosen[0], axis.upper ?? chosen[1]]);
  }

  // The abscissa of a panel; of those in a column often only the last one has its name.
  const abscissa = (data, i) => data.panels.slice(i).find((panel, k) => k % data.columns === 0 && panel.x.label)?.x.label ?? "x";

  class Panel {
    constructor(data, abscissaName, box, size, hidden) {
      this.data = data;
      this.abscissa = abscissaName;
      this.hidden = hidden;
      this.width = Math.max(120, size[0] - margin.left - margin.right);
      this.height = Math.max(120, size[1] - margin.top - margin.bottom);
      const all = (name) => data.series.flatMap((series) => series[name]);
      this.x0 = scaleOf(data.x, all("x"), [0, this.width], false);
      this.y0 = scaleOf(data.y, all("y"), [this.height, 0], true);
      this.make(box, size);
      this.listen();
      this.draw();
    }

    make(box, size) {
      const name = `${this.data.y.label} over ${this.abscissa}`;
      this.svg = d3.select(box).append("svg").attr("width", size[0]).attr("height", size[1])
        .attr("tabindex", 0).attr("role", "img").attr("aria-label", parts(name).map((part) => part.text).join(""));
      const root = this.svg.append("g").attr("transform", `translate(${margin.left},${margin.top})`);
      const clip = `clip${Panel.count = (Panel.count ?? 0) + 1}`;
      root.append("clipPath").attr("id", clip).append("rect").attr("width", this.width).attr("height", this.height);
      this.xAxis = root.append("g").attr("class", "axis").attr("transform", `translate(0,${this.height})`);
      this.yAxis = root.append("g").attr("class", "axis");
      this.plot = root.append("g").attr("clip-path", `url(#${clip})`);
      this.marks = root.append("g");  // not cut where they are on the edge
      this.outer = root.append("g");
      this.dot = root.append("circle").attr("class", "dot").attr("r", 4).attr("visibility", "hidden");
      title(root, this.data.x.label, this.width + margin.right, (i, n) => `translate(${this.width / 2},${this.height + (n === 1 ? 36 : 31 + 13 * i)})`);
      title(root, this.data.y.label, this.height + 2 * margin.top,
        (i, n) => `translate(${n === 1 ? -46 : 13 * i - 53},${this.height / 2})rotate(-90)`);
      this.values = element("div", { class: "values", role: "status", hidden: "" });
      box.append(this.values);
    }

    listen() {
      const node = this.svg.node();
      this.zoom = d3.zoom().scaleExtent([1, 1000]).extent([[0, 0], [this.width, this.height]])
        .translateExtent([[0, 0], [this.width, this.height]])
        .filter(() => this.takes(d3.event ?? {})).on("zoom", () => this.draw());
      this.svg.call(this.zoom).on("dblclick.zoom", () => this.reset());
      node.addEventListener("pointermove", (event) => this.point(event));
      node.addEventListener("pointerleave", () => this.leave());
      node.addEventListener("keydown", (event) => this.key(event));
    }

    // The wheel scrolls the page unless Ctrl is held, as on maps; one finger does so unless the panel is enlarged.
    takes(event) {
      if (event.type === "wheel") return event.ctrlKey || event.metaKey;
      const fingers = event.touches?.length ?? 2;
      return !event.button && (fingers > 1 || d3.zoomTransform(this.svg.node()).k > 1);
    }

    reset() { this.svg.call(this.zoom.transform, d3.zoomIdentity); }

    key(event) {
      const moves = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
      const scale = d3.zoomTransform(this.svg.node()).k;
      if (event.key === "+" || event.key === "-") this.svg.call(this.zoom.scaleBy, event.key === "+" ? 1.5 : 1 / 1.5);
      else if (event.key === "0") this.reset();
      else if (moves[event.key] && scale > 1)
        this.svg.call(this.zoom.translateBy, ...moves[event.key].map((pixels) => pixels / scale));
      else if (moves[event.key]) this.step(event.key);
      else return;
      event.preventDefault();
    }

    // Left and right keys show the points of a curve one after another, up and down keys change the curve.
    step(key) {
      const curves = telling(this.shown()).filter((series) => series.y.some((value, i) => finite(this.x, series.x[i]) && finite(this.y, value)));
      if (curves.length === 0) return;
      const by = { ArrowUp: -1, ArrowDown: 1 }[key] ?? 0;
      const series = curves[(Math.max(0, curves.indexOf(this.told)) + by + curves.length) % curves.length];
      if (series !== this.told) this.index = key === "ArrowLeft" ? series.x.length : -1;
      this.told = series;
      const there = (i) => finite(this.x, series.x[i]) && finite(this.y, series.y[i]);
      do this.index = (this.index + (key === "ArrowLeft" ? -1 : 1) + series.x.length) % series.x.length; while (!there(this.index));
      this.tell({ series, at: [this.x(series.x[this.index]), this.y(series.y[this.index])], told: series.told?.[this.index],
                  row: series.cells?.rows[this.index] });
    }

    draw() {
      const transform = d3.zoomTransform(this.svg.node());
      this.x = transform.rescaleX(this.x0);
      this.y = transform.rescaleY(this.y0);
      const ticks = (axis, given, count) => {
        const chosen = given.ticks.length && transform.k === 1;
        const format = tickFormat(given, axis.scale(), count, chosen);
        return axis.ticks(count).tickValues(chosen ? given.ticks : null).tickFormat((value, i) => format(value, i).replace(/,/g, ""));
      };
      this.xAxis.call(ticks(d3.axisBottom(this.x), this.data.x, this.width / 80).tickSizeInner(-this.height).tickSizeOuter(0).tickPadding(7));
      this.yAxis.call(ticks(d3.axisLeft(this.y), this.data.y, this.height / 45).tickSizeInner(-this.width).tickSizeOuter(0).tickPadding(7));
      this.spread(this.xAxis);
      this.svg.style("touch-action", transform.k > 1 ? "none" : "pan-y");
      for (const group of [this.plot, this.marks, this.outer]) group.selectAll("*").remove();
      const areas = this.data.series.filter((series) => series.area && this.hidden.has(key(series))).map((series) => series.colour);
      this.data.rectangles.filter((one) => !areas.includes(one.colour)).forEach((one) => this.rectangle(one));
      this.data.segments.forEach((one) => this.segment(one));
      this.shown().forEach((series) => this.curve(series));
      for (const mark of this.data.texts)
        svgText(this.plot.append("text").attr("x", this.x(mark.x)).attr("y", this.y(mark.y)).attr("dy", "0.32em")
          .attr("text-anchor", mark.anchor), mark.text);
      this.leave();
    }

    // Numbers that would overlap the previous one are left out.
    spread(axis) {
      let end = -Infinity;
      axis.selectAll(".tick text").attr("visibility", null).each(function () {
        const { left, right, width } = this.getBoundingClientRect();
        if (width > 0 && left < end + 4) this.setAttribute("visibility", "hidden");
        else if (width > 0) end = right;
      });
    }

    shown() { return this.data.series.filter((series) => !this.hidden.has(key(series))); }

    rectangle(one) {
      const x = d3.extent(one.x.map(this.x)), y = d3.extent(one.y.map(this.y));
      this.plot.append("rect").attr("x", x[0]).attr("y", y[0]).attr("width", x[1] - x[0]).attr("height", y[1] - y[0])
        .attr("fill", one.colour).attr("opacity", one.opacity);
    }

    segment(one) {
      const at = ([x, y], edgeX, edgeY) => [x === null ? edgeX : this.x(x), y === null ? edgeY : this.y(y)];
      const [a, b] = [at(one.from, 0, this.height), at(one.to, this.width, 0)];
      this.plot.append("line").attr("x1", a[0]).attr("y1", a[1]).attr("x2", b[0]).attr("y2", b[1])
        .attr("stroke", one.colour).attr("stroke-width", one.width).attr("stroke-dasharray", one.dash || null);
      if (one.label && b[1] >= 0 && b[1] <= this.height)
        svgText(this.outer.append("text").attr("x", this.width - 4).attr("y", b[1] - 4).attr("text-anchor", "end"), one.label);
    }

    cells({ cells, x, y }) {
      const at = (i) => cells.range[0] + (i / (cells.colours.length - 1)) * (cells.range[1] - cells.range[0]);
      const colour = d3.scaleLinear().domain(cells.colours.map((_, i) => at(i))).range(cells.colours).clamp(true);
      cells.values.forEach((value, i) => {
        if (value !== null)
          this.rectangle({ x: [x[i] - cells.half[0], x[i] + cells.half[0]], y: [y[i] - cells.half[1], y[i] + cells.half[1]],
                           colour: colour(value), opacity: 1 });
      });
    }

    curve(series) {
      if (series.cells) return this.cells(series);
      const { x, y } = this;
      const at = series.x.map((value, i) => [x(value), finite(x, value) && finite(y, series.y[i]) ? y(series.y[i]) : NaN]);
      const there = ([, v]) => Number.isFinite(v);
      const inside = ([u, v]) => u > -0.5 && u < this.width + 0.5 && v > -0.5 && v < this.height + 0.5;
      if (series.style === "impulses") {
        for (const [u, v] of at.filter(there))
          this.plot.append("line").attr("x1", u).attr("x2", u).attr("y1", Math.min(this.height, y(0))).attr("y2", v)
            .attr("stroke", series.colour).attr("stroke-width", series.width);
      } else if (series.style !== "points") {
        const line = d3.line().defined(there);
        if (series.style === "steps") line.curve(d3.curveStepAfter);
        this.plot.append("path").attr("class", "curve").attr("d", line(at)).attr("stroke", series.colour)
          .attr("stroke-width", series.width).attr("stroke-dasharray", series.dash || null);
      }
      if (series.style !== "points" && series.style !== "line_points") return;
      at.filter((point, i) => i % series.every === 0 && inside(point)).forEach(([u, v]) => mark(this.marks, series, u, v));
    }

    // The point of a series next to the pixel (u, v): one of its points where they have symbols, else on the lines between.
    nearest(series, u, v) {
      let best = { distance: reach };
      if (series.cells) {
        const x = this.x.invert(u), y = this.y.invert(v), [width, height] = series.cells.half;
        const i = series.x.findIndex((value, k) => Math.abs(x - value) <= width && Math.abs(y - series.y[k]) <= height);
        return i < 0 ? best : { distance: 0, at: [this.x(series.x[i]), this.y(series.y[i])], series, row: series.cells.rows[i] };
      }
      let before = null;
      const joined = series.style === "line";
      series.x.forEach((value, i) => {
        const there = finite(this.x, value) && finite(this.y, series.y[i]);
        const point = there ? [this.x(value), this.y(series.y[i])] : null;
        if (point) {
          const from = joined && before ? before : point;
          const d = [point[0] - from[0], point[1] - from[1]], square = d[0] ** 2 + d[1] ** 2;
          const share = square ? Math.min(1, Math.max(0, ((u - from[0]) * d[0] + (v - from[1]) * d[1]) / square)) : 0;
          const at = [from[0] + share * d[0], from[1] + share * d[1]];
          const distance = Math.hypot(u - at[0], v - at[1]);
          if (distance < best.distance) best = { distance, at, series, told: series.told?.[i] };
        }
        before = point;
      });
      return best;
    }

    point(event) {
      const box = this.svg.node().getBoundingClientRect();
      const u = event.clientX - box.left - margin.left, v = event.clientY - box.top - margin.top;
      const inside = u >= 0 && v >= 0 && u <= this.width && v <= this.height;
      const found = telling(this.shown()).map((series) => this.nearest(series, u, v));
      const best = inside ? found.reduce((a, b) => (b.distance < a.distance ? b : a), { distance: reach }) : {};
      if (best.at) this.tell(best);
      else this.leave();
    }

    // Shows the values at a place of a curve.
    tell(best) {
      const [x, y] = best.at;
      this.dot.attr("cx", x).attr("cy", y).attr("fill", best.series.colour).attr("visibility", "visible");
      const line = (label, value) => element("div", {}, ...html(label || "value"), `: ${number(value)}`);
      const lines = best.row ? best.row.map((value, i) => line(best.series.cells.heads[i], value))
        : [line(this.abscissa, best.told ?? this.x.invert(x)), line(this.data.y.label, this.y.invert(y))];
      this.values.replaceChildren(element("strong", {}, ...html(best.series.label)), ...lines);
      this.values.hidden = false;
      const right = x > this.width / 2;
      this.values.style.left = right ? "" : `${x + margin.left + 12}px`;
      this.values.style.right = right ? `${this.width - x + margin.right + 12}px` : "";
      this.values.style.top = `${Math.max(0, Math.min(y, this.height - 70))}px`;
    }

    leave() {
      this.dot.attr("visibility", "hidden");
      this.values.hidden = true;
    }
  }

  // One entry of the legend represents the curves of that name and look in all panels.
  const key = (series) => [series.label, series.colour, series.dash, series.style].join("|");

  const hasPoint = (series) => series.x.some((x, i) => x !== null && series.y[i] !== null);
  const areaOpacity = (data, series) => data.panels.find((panel) => panel.series.includes(series)).rectangles
    .find((one) => one.colour === series.colour)?.opacity ?? 1;

  // Meaning of the colours of a map.
  const colourBar = ({ title, range, colours }) => element("span", { class: "range" }, ...html(title), ` ${wavebalance.number(range[0])} `,
    element("span", { style: `background: linear-gradient(90deg, ${colours})` }), ` ${wavebalance.number(range[1])}`);

  function legend(data, hidden, redraw) {
    const entries = new Map();
    for (const panel of data.panels)
      for (const series of panel.series)
        if (series.label && (series.area || hasPoint(series))) entries.set(key(series), series);
    const bars = data.panels.flatMap((panel) => panel.series).filter((series) => series.cells).map((series) => colourBar(series.cells));
    return element("div", { class: "legend" }, ...bars, ...[...entries].map(([name, series]) => {
      const swatch = d3.create("svg").attr("class", "swatch").attr("width", 28).attr("height", 12).attr("aria-hidden", "true");
      if (series.area)
        swatch.append("rect").attr("width", 28).attr("height", 12).attr("fill", series.colour).attr("opacity", areaOpacity(data, series));
      else if (series.style !== "points")
        swatch.append("line").attr("x2", 28).attr("y1", 6).attr("y2", 6).attr("stroke", series.colour).attr("stroke-width", 2.5)
          .attr("stroke-dasharray", series.dash || null);
      if (series.style.endsWith("points")) mark(swatch, series, 14, 6);
      const button = element("button", { type: "button", "aria-pressed": "true" }, swatch.node(), ...html(series.label));
      button.addEventListener("click", () => {
        if (!hidden.delete(name)) hidden.add(name);
        button.setAttribute("aria-pressed", String(!hidden.has(name)));
        redraw();
      });
      return button;
    }));
  }

  // As many columns as the picture has, or a divisor of that number, so that panels below each other stay so.
  function columnsFor(wanted, width) {
    let columns = Math.max(1, wanted);
    while (columns > 1 && (wanted % columns || width / columns < 200)) --columns;
    return columns;
  }

  function drawFigure(box, data) {
    const hidden = new Set();
    const panels = [];
    const grid = element("div", { class: "panels" });
    box.replaceChildren(grid);
    const width = grid.clientWidth;
    const columns = columnsFor(Math.min(data.columns, data.panels.length), width);
    grid.style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
    const each = Math.max(1, Math.floor(width / columns) - 1);  // 1 in a window that has no size yet
    const redraw = () => panels.forEach((panel) => panel.draw());
    box.replaceChildren();
    if (data.title) box.append(element("p", { class: "title" }, ...html(data.title)));
    box.append(legend(data, hidden, redraw), grid);
    box.querySelectorAll(".title").forEach(wavebalance.keepTogether);
    data.panels.forEach((panel, index) => {
      const letter = data.letters ? [element("b", {}, `(${String.fromCharCode(97 + index)}) `)] : [];
      const place = element("div", { class: "panel" }, element("p", {}, ...letter, ...html(panel.title)));
      const plot = element("div", { class: "plot" });
      place.append(plot);
      grid.append(place);
      const height = Math.max(200, Math.min(420, (each * data.panel[1]) / data.panel[0]));
      panels.push(new Panel(panel, abscissa(data, index), plot, [each, height], hidden));
    });
    return () => panels.forEach((panel) => panel.reset());
  }

  function prepare(figure) {
    const source = figure.dataset.curves;
    const name = source.slice(source.lastIndexOf("/") + 1, -".figure.js".length);
    const picture = figure.querySelector("a");
    const box = element("div", { class: "curves", hidden: "" });
    const hint = element("span", { class: "hint", hidden: "" }, "Point at a curve for its values, or use the arrow keys. Ctrl + wheel or a " +
      "pinch zooms, dragging moves, a double click resets; a name hides its curve.");
    const button = element("button", { type: "button", "aria-pressed": "false" }, "Zoom and read values");
    const again = element("button", { type: "button", hidden: "" }, "Reset");
    let reset = () => {};
    again.addEventListener("click", () => reset());
    button.addEventListener("click", async () => {
      const show = box.hidden;
      if (show) await wavebalance.load(source);
      for (const node of [box, hint, again]) node.hidden = !show;
      picture.hidden = show;
      button.setAttribute("aria-pressed", String(show));
      button.textContent = show ? "Show the picture" : "Zoom and read values";
      if (show) reset = drawFigure(box, wavebalance.figures[name]);
    });
    picture.after(box, element("div", { class: "tools" }, button, again, hint), valuesOf(source, name));
    figure.redrawCurves = () => { if (box.clientWidth > 0) reset = drawFigure(box, wavebalance.figures[name]); };
  }

  // The points of a curve as a table, at most so many of them.
  function table(panel, abscissaName, letter, series) {
    const most = 100, every = Math.max(1, Math.ceil(series.x.length / most));
    const row = (tag, ...cells) => element("tr", {}, ...cells.map((cell) => element(tag, {}, ...[cell].flat())));
    const rows = [];
    const heads = series.cells?.heads ?? [abscissaName, panel.y.label || "y"];
    for (let i = 0; i < series.x.length; i += every)
      if (series.y[i] !== null) rows.push(row("td", ...(series.cells?.rows[i] ?? [(series.told ?? series.x)[i], series.y[i]]).map(number)));
    const name = element("caption", {}, `${letter} `, ...html(series.label || panel.title), every > 1 ? `, one point of ${every}` : "");
    return element("table", {}, name, element("thead", {}, row("th", ...heads.map(html))),
      element("tbody", {}, ...rows));
  }

  function valuesOf(source, name) {
    const place = element("div", { class: "wide tables" });
    const details = element("details", { class: "table-of-values" }, element("summary", {}, "Table of values"), place);
    details.addEventListener("toggle", async () => {
      if (!details.open || place.firstChild) return;
      await wavebalance.load(source);
      const data = wavebalance.figures[name];
      data.panels.forEach((panel, i) => telling(panel.series).filter(hasPoint).forEach((series) =>
        place.append(table(panel, abscissa(data, i), data.letters ? `(${String.fromCharCode(97 + i)})` : "", series))));
    });
    return details;
  }

  document.addEventListener("DOMContentLoaded", () => {
    if (!window.d3) return;
    const figures = [...document.querySelectorAll("figure[data-curves]")];
    figures.forEach(prepare);
    let width = window.innerWidth;
    window.addEventListener("resize", () => {
      if (window.innerWidth === width) return;
      width = window.innerWidth;
      figures.forEach((figure) => figure.redrawCurves());
    });
    // On narrow screens the panels of the curves are below each other, unlike in a picture.
    if (window.matchMedia("(max-width: 700px)").matches)
      wavebalance.whenNear("figure[data-curves]", (figure) => figure.querySelector(".tools button").click());
  });
})();
