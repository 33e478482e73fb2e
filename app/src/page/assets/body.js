// Moves a body in space over a period with three.js: coloured by the size of its displacement, turned by dragging.
"use strict";
(() => {
  const element = wavebalance.element;
  const period = 4000;  // milliseconds per period when played
  const resting = 0.4;  // of the colours, for lines at rest: white ones cannot be seen

  // White to dark blue, as the pictures have it; `depth` in 0..1.
  function colour(depth) {
    const ends = [[0.97, 0.98, 1.0], [0.42, 0.68, 0.84], [0.03, 0.19, 0.42]];
    const place = Math.min(0.9999, Math.max(0, depth)) * 2, low = Math.floor(place);
    return ends[low].map((value, i) => value + (place - low) * (ends[low + 1][i] - value));
  }

  // Fixed parts: the edges of the surface at rest, and its beams.
  function outline(geometry, data) {
    const edges = Array.from(new THREE.EdgesGeometry(geometry, 50).attributes.position.array);
    const rest = geometry.attributes.position.array;
    for (const point of data.segments || []) edges.push(...rest.slice(3 * point, 3 * point + 3));
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.Float32BufferAttribute(edges, 3));
    return lines;
  }

  // The beams, between points that the surface and they share.
  function moving(geometry, segments) {
    const lines = new THREE.BufferGeometry();
    for (const name of ["position", "color"]) lines.setAttribute(name, geometry.attributes[name]);
    lines.setIndex(segments);
    return new THREE.LineSegments(lines, new THREE.LineBasicMaterial({ vertexColors: true }));
  }

  class Body {
    constructor(renderer, width, height) {
      this.renderer = renderer;
      this.renderer.setPixelRatio(window.devicePixelRatio);
      this.renderer.setClearColor(0xffffff);
      this.scene = new THREE.Scene();
      this.camera = new THREE.PerspectiveCamera(30, width / height, 0.001, 100);
      this.camera.up.set(0, 0, 1);
      const light = new THREE.DirectionalLight(0xffffff, 0.45);
      light.position.set(0.3, 0.6, 1);
      this.camera.add(light);
      this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.62));
      [this.azimuth, this.elevation] = [-0.61, 0.38];
      this.canvas = this.renderer.domElement;
      this.canvas.tabIndex = 0;
      this.canvas.setAttribute("role", "img");
      this.canvas.setAttribute("aria-label", "The body in motion; arrow keys turn it");
      this.canvas.addEventListener("pointerdown", (event) => this.canvas.setPointerCapture(event.pointerId));
      this.canvas.addEventListener("pointermove", (event) => { if (event.buttons) this.turn(event.movementX, event.movementY); });
      this.canvas.addEventListener("keydown", (event) => {
        const by = { ArrowLeft: [-15, 0], ArrowRight: [15, 0], ArrowUp: [0, -15], ArrowDown: [0, 15] }[event.key];
        if (!by) return;
        event.preventDefault();
        this.turn(...by);
      });
      this.resize(width, height);
    }

    resize(width, height) {
      this.renderer.setSize(width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
    }

    // `largest` is the displacement with the last colour, the same for all compared motions.
    load(data, largest) {
      if (this.mesh) this.scene.remove(this.mesh, this.outline);
      this.data = data;
      this.largest = largest;
      this.rest = data.points.map((value) => value * data.length);
      const geometry = new THREE.BufferGeometry();
      geometry.setIndex(data.triangles);
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(this.rest.slice(), 3));
      this.outline = new THREE.LineSegments(outline(geometry, data), new THREE.LineBasicMaterial({ color: 0x777777 }));
      geometry.setAttribute("color", new THREE.Float32BufferAttribute(new Float32Array(this.rest.length), 3));
      this.mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide }));
      this.mesh.add(moving(geometry, data.segments || []));
      this.scene.add(this.mesh, this.outline);
      geometry.computeBoundingSphere();
      this.sphere = geometry.boundingSphere.clone();
    }

    // `time` in periods; between two frames displacements are interpolated linearly.
    show(time) {
      this.time = time;
      const frames = this.data.frames, place = (time % 1) * frames.length, low = Math.floor(place) % frames.length;
      const [a, b, between] = [frames[low], frames[(low + 1) % frames.length], place - Math.floor(place)];
      const least = this.data.triangles.length > 0 ? 0 : resting;
      const { position, color } = this.mesh.geometry.attributes;
      for (let i = 0; i < a.length; i += 3) {
        const u = [0, 1, 2].map((k) => (a[i + k] + between * (b[i + k] - a[i + k])) * this.data.unit);
        for (let k = 0; k < 3; ++k) position.array[i + k] = this.rest[i + k] + (this.data.times || 1) * u[k];
        color.array.set(colour(least + (1 - least) * Math.hypot(...u) / this.largest), i);
      }
      position.needsUpdate = color.needsUpdate = true;
      this.mesh.geometry.computeVertexNormals();
      this.render();
    }

    turn(right, down) {
      this.azimuth -= right * 0.01;
      this.elevation = Math.max(-1.5, Math.min(1.5, this.elevation + down * 0.01));
      this.render();
    }

    render() {
      const { center, radius } = this.sphere, distance = 4.1 * radius;
      const flat = Math.cos(this.elevation) * distance;
      this.camera.position.set(center.x + flat * Math.cos(this.azimuth), center.y + flat * Math.sin(this.azimuth),
        center.z + Math.sin(this.elevation) * distance);
      this.camera.lookAt(center);
      this.renderer.render(this.scene, this.camera);
    }
  }

  function build(box, names, renderer) {
    const motions = names.map((name) => wavebalance.bodies[name]);
    const largest = Math.max(...motions.map((one) => one.largest));
    const unit = wavebalance.unitOf(largest);
    const size = () => { const width = Math.max(220, box.clientWidth); return [width, Math.min(520, 0.75 * width)]; };
    const body = new Body(renderer, ...size());
    const list = element("select", { "aria-label": "Motion" }, ...motions.map((one, i) => element("option", { value: i }, one.label)));
    list.hidden = motions.length === 1;
    const slider = element("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0, "aria-label": "Time" });
    const instant = element("output", { class: "quiet" });
    const show = (time) => {
      slider.value = time;
      instant.textContent = `t = ${time.toFixed(2)} T`;
      body.show(time);
    };
    const play = wavebalance.player(period, () => Number(slider.value), show);
    slider.addEventListener("input", () => { play.pause(); show(Number(slider.value)); });
    list.addEventListener("change", () => { body.load(motions[list.value], largest); show(Number(slider.value)); });
    box.replaceChildren(wavebalance.heading(box, "The body over a period"), element("div", { class: "tools" }, list, play.button, slider, instant), body.canvas,
      element("p", { class: "quiet" }, `Displacements ${(motions[0].times || 1) === 1 ? "as they are" :
        `drawn ${motions[0].times} times as large`}; ${motions[0].triangles.length > 0 ? "white" : "blue"} at rest, ` +
        `dark blue at ${wavebalance.number(unit.factor * largest, 3)} ${unit.name} in all ` +
        "motions. Thin lines: the body at rest. Drag to turn it."));
    body.load(motions[0], largest);
    new ResizeObserver(() => { body.resize(...size()); body.render(); }).observe(box);
    show(0);
  }

  async function start(box) {
    const sources = box.dataset.bodies.split(" ");
    const library = box.dataset.library ? [box.dataset.library] : [];  // a report has it in itself
    for (const source of [...library, ...sources]) await wavebalance.load(source);
    const Renderer = THREE.WebGLRenderer;
    let renderer;
    try {
      renderer = new Renderer({ antialias: true });
    } catch {
      box.replaceChildren(element("p", { class: "quiet" }, "This browser draws no bodies in space (WebGL), so that the body does not move here."));
      return;
    }
    build(box, sources.map((source) => source.slice(source.lastIndexOf("/") + 1, -".body.js".length)), renderer);
  }

  document.addEventListener("DOMContentLoaded", () => wavebalance.whenNear(".body-motion", start));
})();
