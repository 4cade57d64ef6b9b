'use strict';
// The finished part as columns, as Stock has them: heights in runs of [how many, micrometres].
class Part {
  constructor() {
    const p = DATA.part;
    [this.lo, this.hi] = DATA.stock.box;
    this.nx = p.nx; this.ny = p.ny;
    this.top = Part.heights(p.top); this.bottom = Part.heights(p.bottom);
  }
  static heights(runs) {
    const out = [];
    for (let k = 0; k < runs.length; k += 2) for (let n = 0; n < runs[k]; ++n) out.push(runs[k + 1] / 1000);
    return out;
  }
  x(i) { return this.lo[0] + (this.hi[0] - this.lo[0]) * i / (this.nx - 1); }
  y(j) { return this.lo[1] + (this.hi[1] - this.lo[1]) * j / (this.ny - 1); }
}
function featureOf(id) { return DATA.features.find(f => f.id === id) || {id, solids: []}; }

// The workpiece as columns, each with one piece of material from a lower to an upper height, in the workpiece's frame. A cut
// from +Z lowers the upper height, one from -Z raises the lower. Set-ups that look along another axis leave it as it is.
class Stock {
  constructor(cells) {
    const [lo, hi] = DATA.stock.box;
    this.lo = lo; this.hi = hi;
    this.cell = Math.max(hi[0] - lo[0], hi[1] - lo[1]) / cells;
    this.nx = Math.max(2, Math.ceil((hi[0] - lo[0]) / this.cell) + 1);
    this.ny = Math.max(2, Math.ceil((hi[1] - lo[1]) / this.cell) + 1);
    this.top = new Float32Array(this.nx * this.ny);
    this.bottom = new Float32Array(this.nx * this.ny);
    this.reset();
  }
  x(i) { return this.lo[0] + (this.hi[0] - this.lo[0]) * i / (this.nx - 1); }
  y(j) { return this.lo[1] + (this.hi[1] - this.lo[1]) * j / (this.ny - 1); }
  reset() {
    const r = DATA.stock.radius, mx = (this.lo[0] + this.hi[0]) / 2, my = (this.lo[1] + this.hi[1]) / 2;
    for (let j = 0, n = 0; j < this.ny; ++j) {
      for (let i = 0; i < this.nx; ++i, ++n) {
        const there = r === null || Math.hypot(this.x(i) - mx, this.y(j) - my) <= r;
        this.bottom[n] = this.lo[2];
        this.top[n] = there ? this.hi[2] : this.lo[2];
      }
    }
    this.done = {step: 0, point: 0};
  }
  // Cuts the steps in order up to a point of a step; begins anew when that lies behind what is cut.
  cutTo(step, point) {
    const d = this.done;
    if (step < d.step || (step === d.step && point < d.point)) this.reset();
    for (let s = this.done.step; s <= step && s < DATA.steps.length; ++s) {
      const last = s === step ? point : lastPoint(s);
      this.cut(s, s === this.done.step ? this.done.point : 0, last);
    }
    this.done = {step, point};
  }
  cut(s, from, to) {
    const step = DATA.steps[s], tool = toolOf(step), p = pointsOf(step);
    const [origin, ex, ey, ez] = DATA.setups[step.setup].piece;  // the workpiece's frame, in the set-up's
    const up = ez[2] > 0.999 ? 1 : ez[2] < -0.999 ? -1 : 0;
    if (!tool || !up) return;
    const local = (x, y, z) => {
      const d = [x - origin[0], y - origin[1], z - origin[2]], dot = e => d[0] * e[0] + d[1] * e[1] + d[2] * e[2];
      return [dot(ex), dot(ey), dot(ez)];
    };
    const shape = this.shape(tool);
    for (let k = Math.max(1, from); k <= to; ++k) {
      if (p.rapid[k]) continue;
      const a = local(p.x[k - 1], p.y[k - 1], p.z[k - 1]), b = local(p.x[k], p.y[k], p.z[k]);
      const n = Math.max(1, Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) / (0.7 * this.cell)));
      for (let t = 1; t <= n; ++t) {
        const f = t / n;
        this.stamp(shape, a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2]), up);
      }
    }
  }
  // Heights of the cutter's outline above its tip at cells of the grid.
  shape(tool) {
    if (tool.shape && tool.shapeCell === this.cell) return tool.shape;
    const o = tool.outline, r = o[o.length - 1][0], n = Math.ceil(r / this.cell);
    const height = d => {
      const at = d / r * (o.length - 1), i = Math.min(Math.floor(at), o.length - 2);
      return o[i][1] + (at - i) * (o[i + 1][1] - o[i][1]);
    };
    tool.shape = {r, n, height}; tool.shapeCell = this.cell;
    return tool.shape;
  }
  stamp(shape, x, y, z, up) {
    const dx = (this.hi[0] - this.lo[0]) / (this.nx - 1), dy = (this.hi[1] - this.lo[1]) / (this.ny - 1);
    const i0 = Math.max(0, Math.ceil((x - shape.r - this.lo[0]) / dx)), i1 = Math.min(this.nx - 1, Math.floor((x + shape.r - this.lo[0]) / dx));
    const j0 = Math.max(0, Math.ceil((y - shape.r - this.lo[1]) / dy)), j1 = Math.min(this.ny - 1, Math.floor((y + shape.r - this.lo[1]) / dy));
    for (let j = j0; j <= j1; ++j) {
      for (let i = i0; i <= i1; ++i) {
        const d = Math.hypot(this.x(i) - x, this.y(j) - y);
        if (d > shape.r) continue;
        const n = j * this.nx + i, h = z + up * shape.height(d);
        if (up > 0) this.top[n] = Math.max(Math.min(this.top[n], h), this.bottom[n]);
        else this.bottom[n] = Math.min(Math.max(this.bottom[n], h), this.top[n]);
      }
    }
  }
  // mm3; a column at the edge stands for half a cell.
  volume() {
    let v = 0;
    for (let j = 0, n = 0; j < this.ny; ++j) {
      for (let i = 0; i < this.nx; ++i, ++n) {
        const edges = (i === 0 || i === this.nx - 1 ? 1 : 0) + (j === 0 || j === this.ny - 1 ? 1 : 0);
        v += (this.top[n] - this.bottom[n]) / (1 << edges);
      }
    }
    return v * (this.hi[0] - this.lo[0]) * (this.hi[1] - this.lo[1]) / ((this.nx - 1) * (this.ny - 1));
  }
}
