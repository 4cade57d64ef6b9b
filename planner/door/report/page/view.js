'use strict';
// The view in three dimensions, in the set-up's frame, by three.js; flat where the page has no three.js or the browser no
// WebGL. One view shows one set-up: a step of it, or all of them.
const BACK = 0xf4f6f8;
const CELLS = 220;  // columns of the stock, along the longer side
class View {
  constructor(host) {
    this.host = host;
    this.stock = new Stock(CELLS);
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
    this.controls.addEventListener('change', () => { if (!this.laying) this.draw(); });
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
  // A set-up as a picture, with the stock as it is after a step (-1: raw). Afterwards `restore`.
  picture(n, after, w, h) {
    const out = el('canvas', {width: w, height: h, role: 'img'}), shown = this.stock;
    for (const name of ['paths', 'cutter', 'marked']) this.put(name, null);
    this.lay(n);
    if (!this.paper) this.paper = new Stock(CELLS);
    if (after >= 0) this.paper.cutTo(after, lastPoint(after));
    this.stock = this.paper;
    this.mesh({setup: n, stock: true});
    this.stock = shown;
    this.scene.background.set(0xffffff);
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.draw();
    out.getContext('2d').drawImage(this.renderer.domElement, 0, 0, w, h);
    return out;
  }
  // What was shown before pictures were drawn.
  restore() {
    if (this.flat) return;
    this.scene.background.set(BACK);
    this.setup = undefined;
    if (this.shown) this.show(this.shown);
  }
  draw() { if (!this.flat) this.renderer.render(this.scene, this.camera); }

  // state: {setup, steps: [indices], step, point, colour, stock, rapids}
  show(state) {
    this.shown = state;
    if (this.flat) {
      const steps = state.steps.map(i => ({step: DATA.steps[i], colour: css(stepColour(i)), upTo: i === state.step ? state.point : Infinity}));
      drop(this.host).append(flatView(DATA.setups[state.setup], steps, 'set-up ' + (state.setup + 1) + ' from above', state.feature));
      return;
    }
    if (this.setup !== state.setup) this.lay(state.setup);
    this.setup = state.setup;
    this.put('paths', this.pathsOf(state));
    this.stock.cutTo(state.step, state.point);
    this.mesh(state);
    this.mark(state);
    this.place(state);
    this.size();
  }

  // Fixtures, axes, camera.
  lay(n) {
    this.put('fixed', null);
    const setup = DATA.setups[n], [lo, hi] = pieceBox(setup), size = Math.max(...[0, 1, 2].map(k => hi[k] - lo[k]));
    this.put('fixed', new THREE.Group());
    for (const s of setup.holding.solids) {
      const outline = new THREE.Shape(s.outline.map(([x, y]) => new THREE.Vector2(x, y)));
      const solid = new THREE.Mesh(new THREE.ExtrudeBufferGeometry(outline, {depth: Math.max(0.01, s.top - s.bottom), bevelEnabled: false}),
        new THREE.MeshLambertMaterial({color: s.presses ? 0xb79a63 : 0xbdb7a8}));
      solid.position.z = s.bottom;
      this.fixed.add(solid);
    }
    const [rawLo, rawHi] = DATA.stock.box, raw = [0, 1, 2].map(k => Math.max(rawHi[k] - rawLo[k], 1e-3));
    const block = new THREE.BoxBufferGeometry(...raw).translate(...[0, 1, 2].map(k => (rawLo[k] + rawHi[k]) / 2));
    this.fixed.add(this.inPiece(new THREE.LineSegments(new THREE.EdgesGeometry(block), new THREE.LineBasicMaterial({color: 0x6c7f94})), n));
    const arm = 0.3 * size, high = 0.07 * size;
    this.fixed.add(new THREE.AxesHelper(arm), label(setup.offset, high, '#1b1f24', 0, 0, -0.7 * high));
    [['X', '#c0392b'], ['Y', '#2c8a4a'], ['Z', '#2f5fb3']].forEach(([name, colour], k) => this.fixed.add(label(name, high, colour, ...[0, 1, 2].map(c => (c === k ? 1.08 * arm : 0)))));
    const middle = [0, 1, 2].map(k => (lo[k] + hi[k]) / 2);
    this.controls.target.set(...middle);
    this.camera.position.set(middle[0] - 0.7 * size, middle[1] - 1.7 * size, middle[2] + 1.5 * size);
    this.camera.near = size / 100; this.camera.far = 30 * size;
    this.laying = true;  // who lays draws
    this.controls.update();
    this.laying = false;
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

  // Takes its place among what is drawn, in place of what had that name.
  put(name, object) {
    if (this[name]) this.scene.remove(this[name]);
    this[name] = object;
    if (object) this.scene.add(object);
  }
  // What is in the workpiece's frame, where the set-up has it.
  inPiece(object, n) {
    const [o, ex, ey, ez] = DATA.setups[n].piece;
    object.matrixAutoUpdate = false;
    object.matrix.set(ex[0], ey[0], ez[0], o[0], ex[1], ey[1], ez[1], o[1], ex[2], ey[2], ez[2], o[2], 0, 0, 0, 1);
    return object;
  }

  // Stock and part. Both: the part shows where the stock is cut down to it, and through what is still to be cut.
  mesh(state) {
    const part = state.part && DATA.part.nx > 0, both = part && state.stock;
    this.put('solid', state.stock ? this.inPiece(columnsMesh(this.stock, {color: 0xb9c7d6, transparent: both, opacity: both ? 0.5 : 1, depthWrite: !both, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2}), state.setup) : null);
    if (part && !this.partMesh) this.partMesh = columnsMesh(new Part(), {color: 0x7fb58a});
    this.put('part', part ? this.inPiece(this.partMesh, state.setup) : null);
  }

  // A feature's prisms, seen through everything.
  mark(state) {
    const solids = state.feature === null || state.feature === undefined ? [] : featureOf(state.feature).solids;
    if (!solids.length) return this.put('marked', null);
    const group = new THREE.Group();
    for (const s of solids) group.add(prismMesh(s));
    return this.put('marked', this.inPiece(group, state.setup));
  }

  // The cutter in its holder where it is.
  place(state) {
    const step = DATA.steps[state.step], tool = step ? toolOf(step) : null, p = step ? pointsOf(step) : null;
    if (!tool || !p || !p.x.length) return this.put('cutter', null);
    const group = new THREE.Group(), k = Math.min(state.point, p.x.length - 1);
    for (const [what, line] of toolParts(tool)) {
      const points = line.map(([d, z]) => new THREE.Vector2(Math.max(d, 1e-3), z)), [low, high] = [points[0], points[points.length - 1]];
      if (what === 'holder') points.unshift(new THREE.Vector2(1e-3, low.y)), points.push(new THREE.Vector2(1e-3, high.y));
      group.add(new THREE.Mesh(new THREE.LatheBufferGeometry(points, 40), new THREE.MeshPhongMaterial({color: TOOL_COLOURS[what], side: THREE.DoubleSide, transparent: true, opacity: what === 'edge' ? 0.8 : 0.45})));
    }
    group.rotation.x = Math.PI / 2;
    group.position.set(p.x[k], p.y[k], p.z[k]);
    return this.put('cutter', group);
  }
}

// Upper and lower surface and sides of columns, where they hold material.
function columnsMesh(s, look) {
  const at = [], index = [], seen = n => s.top[n] - s.bottom[n] > 1e-4;
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
  return new THREE.Mesh(g, new THREE.MeshPhongMaterial({specular: 0x222222, shininess: 25, side: THREE.DoubleSide, flatShading: true, ...look}));
}

// An outline in space and the same, moved: caps and walls.
function prismMesh({outline, down}) {
  const v = a => new THREE.Vector3(...a), normal = v(down).normalize(), u = Math.abs(normal.z) < 0.9 ? new THREE.Vector3(0, 0, 1).cross(normal).normalize() : new THREE.Vector3(1, 0, 0).cross(normal).normalize();
  const w = normal.clone().cross(u), n = outline.length, flat = outline.map(p => new THREE.Vector2(v(p).dot(u), v(p).dot(w)));
  const at = outline.flat().concat(outline.flatMap(p => p.map((c, k) => c + down[k]))), index = [];
  for (const [a, b, c] of THREE.ShapeUtils.triangulateShape(flat, [])) index.push(a, b, c, n + a, n + c, n + b);
  for (let i = 0; i < n; ++i) { const k = (i + 1) % n; index.push(i, k, n + k, i, n + k, n + i); }
  const g = new THREE.BufferGeometry();
  g.setAttribute('position', new THREE.Float32BufferAttribute(at, 3));
  g.setIndex(index);
  const out = new THREE.Mesh(g, new THREE.MeshBasicMaterial({color: 0xe4572e, transparent: true, opacity: 0.45, depthTest: false, side: THREE.DoubleSide}));
  out.renderOrder = 5;
  return out;
}

// Words in the view, of a height in mm, that face whoever looks.
function label(words, height, colour, x, y, z) {
  const canvas = el('canvas', {width: 256, height: 64}), to = canvas.getContext('2d');
  to.font = 'bold 44px sans-serif'; to.textAlign = 'center'; to.textBaseline = 'middle';
  to.lineWidth = 8; to.strokeStyle = '#ffffff'; to.strokeText(words, 128, 32);
  to.fillStyle = colour; to.fillText(words, 128, 32);
  const out = new THREE.Sprite(new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), depthTest: false}));
  out.scale.set(4 * height, height, 1);
  out.position.set(x, y, z);
  out.renderOrder = 6;
  return out;
}
