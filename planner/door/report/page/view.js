'use strict';
// The view in three dimensions, in the set-up's frame, by three.js; flat where the page has no three.js or the browser no
// WebGL. One view shows one set-up: a step of it, or all of them.
const BACK = 0xf4f6f8;
class View {
  constructor(host) {
    this.host = host;
    this.stock = new Stock(220);
    this.flat = true;
    if (typeof THREE === 'undefined') return;
    try {
      this.renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    } catch (error) {
      return;  // no WebGL here
    }
    this.flat = false;
    THREE.Object3D.DefaultUp.set(0, 0, 1);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(BACK);
    this.camera = new THREE.PerspectiveCamera(35, 1, 1, 10000);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.draw());
    this.scene.add(new THREE.AmbientLight(0xffffff, 0.55));
    for (const [x, y, z, power] of [[0.4, -0.7, 1, 0.55], [-0.8, 0.5, 0.6, 0.25]]) {
      const light = new THREE.DirectionalLight(0xffffff, power);
      light.position.set(x, y, z);
      this.scene.add(light);
    }
    host.append(this.renderer.domElement);
    window.addEventListener('resize', () => this.size());
  }

  size() {
    const w = Math.max(this.host.clientWidth, 50), h = Math.max(this.host.clientHeight, 50);
    this.renderer.setPixelRatio(window.devicePixelRatio || 1);
    this.renderer.setSize(w, h, false);  // the style sheet says how large it stands on the page
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
  // A set-up as a picture, with the stock as it is after a step (-1: raw); what is shown stays.
  picture(n, after, w, h) {
    const shown = this.shown, canvas = this.renderer.domElement;
    this.lay(n);
    if (this.paths) this.scene.remove(this.paths);
    if (this.cutter) this.scene.remove(this.cutter);
    if (after < 0) this.stock.reset();
    else this.stock.cutTo(after, lastPoint(after));
    this.mesh({setup: n, stock: true});
    this.scene.background.set(0xffffff);
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.draw();
    const out = el('canvas', {width: w, height: h, role: 'img'});
    out.getContext('2d').drawImage(canvas, 0, 0, w, h);
    this.scene.background.set(BACK);
    this.setup = undefined;
    if (shown) this.show(shown);
    return out;
  }
  draw() { if (!this.flat) this.renderer.render(this.scene, this.camera); }

  // state: {setup, steps: [indices], step, point, colour, stock, rapids}
  show(state) {
    this.shown = state;
    if (this.flat) {
      const steps = state.steps.map(i => ({step: DATA.steps[i], colour: css(stepColour(i)), upTo: i === state.step ? state.point : Infinity}));
      drop(this.host).append(flatView(DATA.setups[state.setup], steps, 'set-up ' + (state.setup + 1) + ' from above'));
      return;
    }
    if (this.setup !== state.setup) this.lay(state.setup);
    this.setup = state.setup;
    if (this.paths) this.scene.remove(this.paths);
    this.paths = this.pathsOf(state);
    this.scene.add(this.paths);
    this.stock.cutTo(state.step, state.point);
    this.mesh(state);
    this.place(state);
    this.size();
  }

  // Fixtures, axes, camera.
  lay(n) {
    if (this.fixed) this.scene.remove(this.fixed);
    const setup = DATA.setups[n], [lo, hi] = pieceBox(setup), size = Math.max(...[0, 1, 2].map(k => hi[k] - lo[k]));
    this.fixed = new THREE.Group();
    for (const s of setup.holding.solids) {
      const outline = new THREE.Shape(s.outline.map(([x, y]) => new THREE.Vector2(x, y)));
      const solid = new THREE.Mesh(new THREE.ExtrudeBufferGeometry(outline, {depth: Math.max(0.01, s.top - s.bottom), bevelEnabled: false}),
        new THREE.MeshLambertMaterial({color: s.presses ? 0xb79a63 : 0xbdb7a8}));
      solid.position.z = s.bottom;
      this.fixed.add(solid);
    }
    this.fixed.add(new THREE.AxesHelper(0.3 * size));
    this.scene.add(this.fixed);
    const middle = [0, 1, 2].map(k => (lo[k] + hi[k]) / 2);
    this.controls.target.set(...middle);
    this.camera.position.set(middle[0] - 0.7 * size, middle[1] - 1.7 * size, middle[2] + 1.5 * size);
    this.camera.near = size / 100; this.camera.far = 30 * size;
    this.controls.update();
  }

  pathsOf(state) {
    const group = new THREE.Group(), colours = COLOURS[state.colour], steps = state.steps.map(i => DATA.steps[i]);
    const top = colours.top ? colours.top(steps) : 1;
    for (const i of state.steps) {
      const step = DATA.steps[i], p = pointsOf(step), own = stepColour(i), value = colours.of ? colours.of(step) : null;
      const last = i === state.step ? state.point : i < state.step || state.all ? p.x.length - 1 : 0;
      const cut = {at: [], colour: []}, rapid = {at: [], colour: []};
      for (let k = 1; k <= last; ++k) {
        if (p.rapid[k] && !state.rapids) continue;
        const to = p.rapid[k] ? rapid : cut, c = p.rapid[k] ? [0.6, 0.64, 0.68] : value ? ramp(value(k) / top) : own;
        to.at.push(p.x[k - 1], p.y[k - 1], p.z[k - 1], p.x[k], p.y[k], p.z[k]);
        to.colour.push(...c, ...c);
      }
      for (const lines of [cut, rapid]) {
        if (!lines.at.length) continue;
        const g = new THREE.BufferGeometry();
        g.setAttribute('position', new THREE.Float32BufferAttribute(lines.at, 3));
        g.setAttribute('color', new THREE.Float32BufferAttribute(lines.colour, 3));
        group.add(new THREE.LineSegments(g, new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors})));
      }
    }
    return group;
  }

  // The stock's upper and lower surface and its sides, in the set-up's frame.
  mesh(state) {
    if (this.solid) this.scene.remove(this.solid);
    this.solid = null;
    if (!state.stock) return;
    const s = this.stock, at = [], index = [], seen = n => s.top[n] - s.bottom[n] > 1e-4;
    for (const z of [s.top, s.bottom])
      for (let j = 0, n = 0; j < s.ny; ++j) for (let i = 0; i < s.nx; ++i, ++n) at.push(s.x(i), s.y(j), z[n]);
    const lower = s.nx * s.ny, wall = (a, b) => index.push(a, lower + a, lower + b, a, lower + b, b);
    const cell = (i, j) => i >= 0 && j >= 0 && i < s.nx - 1 && j < s.ny - 1 && [0, 1, s.nx, s.nx + 1].some(k => seen(j * s.nx + i + k));
    for (let j = 0; j < s.ny - 1; ++j) {
      for (let i = 0; i < s.nx - 1; ++i) {
        if (!cell(i, j)) continue;
        const a = j * s.nx + i, b = a + 1, c = a + s.nx, d = c + 1;
        index.push(a, b, d, a, d, c, lower + a, lower + d, lower + b, lower + a, lower + c, lower + d);
        if (!cell(i, j - 1)) wall(a, b);
        if (!cell(i, j + 1)) wall(d, c);
        if (!cell(i - 1, j)) wall(c, a);
        if (!cell(i + 1, j)) wall(b, d);
      }
    }
    const g = new THREE.BufferGeometry();
    g.setAttribute('position', new THREE.Float32BufferAttribute(at, 3));
    g.setIndex(index);
    const material = new THREE.MeshPhongMaterial({color: 0xb9c7d6, specular: 0x222222, shininess: 25, side: THREE.DoubleSide, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
    this.solid = new THREE.Mesh(g, material);
    const [o, ex, ey, ez] = DATA.setups[state.setup].piece;
    this.solid.matrixAutoUpdate = false;
    this.solid.matrix.set(ex[0], ey[0], ez[0], o[0], ex[1], ey[1], ez[1], o[1], ex[2], ey[2], ez[2], o[2], 0, 0, 0, 1);
    this.scene.add(this.solid);
  }

  // The cutter where it is.
  place(state) {
    if (this.cutter) this.scene.remove(this.cutter);
    this.cutter = null;
    const step = DATA.steps[state.step], tool = step ? toolOf(step) : null, p = step ? pointsOf(step) : null;
    if (!tool || !p || !p.x.length) return;
    const r = tool.outline[tool.outline.length - 1][0], shank = (tool.shank || 2 * r) / 2, flutes = Math.max(tool.flutes, 1);
    const line = tool.outline.map(([d, z]) => new THREE.Vector2(Math.max(d, 1e-3), z));
    line.push(new THREE.Vector2(r, flutes), new THREE.Vector2(shank, flutes), new THREE.Vector2(shank, Math.max(tool.out, flutes)));
    this.cutter = new THREE.Mesh(new THREE.LatheBufferGeometry(line, 40), new THREE.MeshPhongMaterial({color: 0xd9a441, side: THREE.DoubleSide, transparent: true, opacity: 0.75}));
    this.cutter.rotation.x = Math.PI / 2;
    const k = Math.min(state.point, p.x.length - 1);
    this.cutter.position.set(p.x[k], p.y[k], p.z[k]);
    this.scene.add(this.cutter);
  }
}
