// The page of a motion: bodies that move in three.js, a chart of joint values, and their controls.
(() => {
  "use strict";
  const data = JSON.parse(document.getElementById("motion").textContent);
  const $ = (id) => document.getElementById(id);
  const { Vector3, Quaternion } = THREE;

  // Colours differ in lightness too, and curves in their dashes: neither needs colour to be told.
  const COLOURS = ["#2e6da4", "#e08a3c", "#3d9970", "#b0325b", "#8d79c9", "#c5a32c", "#1f5f66",
    "#d97fa6", "#7a5230", "#7fb2dd", "#566b2f", "#a04fb0"];
  const GROUND = "#2b3440", STEEL = "#c4c9cf", PAPER = "#fbfbf9";
  const DASHES = [[], [9, 4], [2, 3], [10, 3, 2, 3], [5, 3], [14, 4], [2, 6], [8, 3, 2, 3, 2, 3]];

  // ---- the numbers --------------------------------------------------------------------------
  // Numbers that change are on a grid, as integers of three bytes, row by row; others are its start.
  function decode(text, frames) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    let k = 0;
    return data.grids.map(([first, step]) => Float64Array.from({ length: frames }, () => {
      if (!step) return first;
      k += 3;
      return (first + bytes[k - 3] + 256 * bytes[k - 2] + 65536 * bytes[k - 1]) * step;
    }));
  }
  const bodies = data.bodies.length, columns = data.coordinates.length;
  for (const circuit of data.circuits) {
    const rows = decode(circuit.rows, circuit.frames);
    const together = (first, count, parts) => Float64Array.from({ length: count * parts * circuit.frames },
      (_, i) => rows[first + parts * Math.floor(i / parts / circuit.frames) + (i % parts)][Math.floor(i / parts) % circuit.frames]);
    circuit.turns = together(0, bodies, 4);
    circuit.places = together(4 * bodies, bodies, 3);
    circuit.values = together(7 * bodies, columns, 1);
  }
  let circuit = data.circuits[0];
  let frame = 0;

  const last = () => circuit.frames - 1;
  // Between frames are cubics through four of them: the first one's index, and their weights.
  const weights = [0, 0, 0, 0];
  function around(at) {
    const i = Math.max(0, Math.min(Math.floor(at) - 1, last() - 3)), t = at - i - 1;
    weights[0] = (-t * (t - 1) * (t - 2)) / 6;
    weights[1] = ((t + 1) * (t - 1) * (t - 2)) / 2;
    weights[2] = (-(t + 1) * t * (t - 2)) / 2;
    weights[3] = ((t + 1) * t * (t - 1)) / 6;
    return i;
  }
  function pose(body, at, quaternion, position) {
    const k = body * circuit.frames + around(at), a = circuit.turns, b = circuit.places;
    const turn = (c) => weights.reduce((sum, w, j) => sum + w * a[4 * (k + j) + c], 0);
    const way = (c) => weights.reduce((sum, w, j) => sum + w * b[3 * (k + j) + c], 0);
    quaternion.set(turn(1), turn(2), turn(3), turn(0)).normalize();
    position.set(way(0), way(1), way(2));
  }
  function value(column, at) {
    const k = column * circuit.frames + around(at);
    return weights.reduce((sum, w, j) => sum + w * circuit.values[k + j], 0);
  }
  const rootTurn = new Quaternion(data.root[1], data.root[2], data.root[3], data.root[0]);
  const bodyTurn = new Quaternion(), bodyPlace = new Vector3();
  function place(body, local, at, target) {
    pose(body, at, bodyTurn, bodyPlace);
    return target.copy(local).applyQuaternion(bodyTurn).add(bodyPlace).applyQuaternion(rootTurn);
  }

  // ---- the stage ----------------------------------------------------------------------------
  const stage = $("stage");
  const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  renderer.outputColorSpace = THREE.SRGBColorSpace;
  renderer.domElement.tabIndex = 0;
  renderer.domElement.setAttribute("aria-label", data.title);
  stage.prepend(renderer.domElement);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(PAPER);
  const camera = new THREE.PerspectiveCamera(data.planar ? 18 : 30, 1, 0.01, 1000);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.enableDamping = true;
  controls.dampingFactor = 0.12;

  // What moves in any circuit: the middle and the radius of it all.
  const bounds = { low: new Vector3(1e9, 1e9, 1e9), high: new Vector3(-1e9, -1e9, -1e9), reach: 0 };
  let middle = null;
  const spot = new Vector3();
  const hubs = data.hubs.map((h) => ({ ...h, at: new Vector3(...h.at) }));
  function includeAll() {
    const before = circuit;
    for (const each of data.circuits) {
      circuit = each;
      for (const hub of hubs) {
        for (let i = 0; i <= last(); i += 4) {
          place(hub.body, hub.at, Math.min(i, last() - 1e-6), spot);
          bounds.low.min(spot);
          bounds.high.max(spot);
          if (middle) bounds.reach = Math.max(bounds.reach, spot.distanceTo(middle));
        }
      }
    }
    circuit = before;
  }
  includeAll();
  middle = bounds.low.clone().add(bounds.high).multiplyScalar(0.5);
  includeAll();
  const radius = Math.max(bounds.reach, data.link * 0.8);
  const L = data.link;

  const root = new THREE.Group();
  root.quaternion.copy(rootTurn);
  scene.add(root);
  const material = (color, options) =>
    new THREE.MeshStandardMaterial({ color, roughness: 0.52, metalness: 0.04, ...options });
  const steel = material(STEEL, { roughness: 0.3, metalness: 0.35 });
  const guide = material("#8b939c", { roughness: 0.4, metalness: 0.2 });
  const dark = material(GROUND, { roughness: 0.6 });
  const paints = data.bodies.map((b) => (b.colour < 0 ? dark : material(COLOURS[b.colour % COLOURS.length])));

  scene.add(new THREE.HemisphereLight("#ffffff", "#d2ccc2", data.planar ? 1.35 : 1.7));
  const sun = new THREE.DirectionalLight("#ffffff", data.planar ? 1.55 : 2.0);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.radius = 5;
  sun.shadow.bias = -0.0006;
  sun.shadow.normalBias = 0.02 * L;
  scene.add(sun, sun.target);
  const fill = new THREE.DirectionalLight("#dfe8ff", 0.7);
  scene.add(fill, fill.target);

  // ---- shapes -------------------------------------------------------------------------------
  const Y = new Vector3(0, 1, 0);
  const vector = (v) => new Vector3(v[0], v[1], v[2]);
  function add(group, geometry, paint, options = {}) {
    const mesh = new THREE.Mesh(geometry, paint);
    mesh.castShadow = options.shadow !== false;
    mesh.receiveShadow = true;
    mesh.userData.body = group.userData.body;
    group.add(mesh);
    return mesh;
  }
  function along(mesh, centre, axis) {
    mesh.position.copy(centre);
    mesh.quaternion.setFromUnitVectors(Y, axis.clone().normalize());
    return mesh;
  }
  function bevelled(outer, inner, length) {
    const bevel = Math.min(outer * 0.22, length * 0.25), h = length / 2;
    const profile = [[inner, -h], [outer - bevel, -h], [outer, -h + bevel], [outer, h - bevel],
      [outer - bevel, h], [inner, h], [inner, -h]];
    return new THREE.LatheGeometry(profile.map(([x, y]) => new THREE.Vector2(x, y)), 40);
  }
  function rod(group, from, to, r, paint) {
    const gap = to.clone().sub(from), length = gap.length();
    if (length < 1e-9) return;
    along(add(group, new THREE.CylinderGeometry(r, r, length, 28), paint),
      from.clone().add(to).multiplyScalar(0.5), gap);
  }
  function box(group, centre, x, y, sizes, paint) {
    const a = x.clone().normalize(), c = a.clone().cross(y).normalize(), b = c.clone().cross(a);
    const mesh = add(group, new THREE.BoxGeometry(...sizes), paint);
    mesh.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(a, b, c));
    mesh.position.copy(centre);
    return mesh;
  }
  // The convex hull of points of the plane, counter-clockwise.
  function hull(points) {
    const sorted = [...points].sort((p, q) => p[0] - q[0] || p[1] - q[1]);
    const turn = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    const half = (list) => {
      const chain = [];
      for (const p of list) {
        while (chain.length > 1 && turn(chain.at(-2), chain.at(-1), p) <= 1e-12 * L * L) chain.pop();
        chain.push(p);
      }
      chain.pop();
      return chain;
    };
    return [...half(sorted), ...half(sorted.reverse())];
  }
  // The outline at a distance of a convex polygon, with round corners, or of a segment.
  function rounded(corners, r) {
    const shape = new THREE.Shape();
    const n = corners.length;
    for (let i = 0; i < n; i++) {
      const [before, here, after] = [corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]];
      const angle = (p, q) => Math.atan2(q[1] - p[1], q[0] - p[0]) - Math.PI / 2;
      let from = angle(before, here), to = angle(here, after);
      if (n === 2) to = from + Math.PI;
      while (to < from - 1e-9) to += 2 * Math.PI;
      shape.absarc(here[0], here[1], r, from, to, false);
    }
    shape.closePath();
    return shape;
  }
  function offsetHole(corners, inset, r) {
    // A smaller polygon of the same sides, moved inwards, with round corners; null if none is left.
    const n = corners.length, lines = [];
    for (let i = 0; i < n; i++) {
      const p = corners[i], q = corners[(i + 1) % n];
      const dx = q[0] - p[0], dy = q[1] - p[1], size = Math.hypot(dx, dy);
      lines.push([p[0] - (dy / size) * (inset + r), p[1] + (dx / size) * (inset + r), dx / size, dy / size]);
    }
    const inner = lines.map((b, i) => {
      const a = lines[(i + n - 1) % n], det = a[2] * b[3] - a[3] * b[2];
      if (Math.abs(det) < 1e-9) return null;
      const t = ((b[0] - a[0]) * b[3] - (b[1] - a[1]) * b[2]) / det;
      return [a[0] + t * a[2], a[1] + t * a[3]];
    });
    if (inner.some((p) => !p)) return null;
    for (let i = 0; i < n; i++) {
      const p = inner[i], q = inner[(i + 1) % n];
      if ((q[0] - p[0]) * lines[i][2] + (q[1] - p[1]) * lines[i][3] < 0.5 * r) return null;
    }
    const outline = rounded(inner, r).getPoints(10).reverse();
    return new THREE.Path(outline);
  }
  function slab(group, normal, points, r, thick, paint) {
    const n = normal.clone().normalize();
    const x = new Vector3(1, 0, 0).cross(n).lengthSq() > 0.2 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
    const a = x.sub(n.clone().multiplyScalar(x.dot(n))).normalize(), b = n.clone().cross(a);
    const origin = points[0];
    const flat = points.map((p) => { const d = p.clone().sub(origin); return [d.dot(a), d.dot(b)]; });
    let corners = hull(flat);
    if (corners.length < 2 || Math.hypot(corners[1][0] - corners[0][0], corners[1][1] - corners[0][1]) < 1e-6 * L) {
      const disc = new THREE.Shape();
      disc.absarc(0, 0, r, 0, 2 * Math.PI, false);
      corners = null;
      return finish(disc);
    }
    const shape = rounded(corners, r);
    if (corners.length > 2) {
      const hole = offsetHole(corners, 0.35 * r, 0.35 * r);
      if (hole) shape.holes.push(hole);
    }
    return finish(shape);
    function finish(outline) {
      const bevel = thick * 0.16;
      const geometry = new THREE.ExtrudeGeometry(outline, {
        depth: thick - 2 * bevel, bevelEnabled: true, bevelThickness: bevel, bevelSize: bevel,
        bevelOffset: -bevel, bevelSegments: 2, curveSegments: 20,
      });
      geometry.translate(0, 0, -(thick - 2 * bevel) / 2);
      const mesh = add(group, geometry, paint);
      mesh.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(a, b, n));
      mesh.position.copy(origin);
    }
  }
  function hatching(group, start, step, slope, count, paint) {
    const at = [];
    for (let i = 0; i < count; i++) {
      const p = start.clone().addScaledVector(step, i), q = p.clone().add(slope);
      at.push(p.x, p.y, p.z, q.x, q.y, q.z);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(at, 3));
    group.add(new THREE.LineSegments(geometry, paint));
  }
  const ink = new THREE.LineBasicMaterial({ color: GROUND });
  const DRAW = {
    rod: (g, at, [r], paint) => rod(g, at[0], at[1], r, paint),
    bar: (g, at, [r]) => {
      rod(g, at[0], at[1], r, steel);
      for (const end of at) add(g, new THREE.SphereGeometry(1.25 * r, 20, 14), g.userData.paint).position.copy(end);
    },
    tube(g, at, [r], paint) {
      for (let i = 0; i + 1 < at.length; i++) {
        rod(g, at[i], at[i + 1], r, paint);
        if (i) add(g, new THREE.SphereGeometry(r, 20, 14), paint).position.copy(at[i]);
      }
    },
    ring: (g, at, [r, length], paint) => along(add(g, bevelled(r, r * 0.4, length), paint), at[0], at[1]),
    pin: (g, at, [r, length]) => along(add(g, bevelled(r, 0.0001 * r, length), steel), at[0], at[1]),
    ball: (g, at, [r], paint) => add(g, new THREE.SphereGeometry(r, 30, 22), paint).position.copy(at[0]),
    steelball: (g, at, [r]) => add(g, new THREE.SphereGeometry(r, 24, 18), steel).position.copy(at[0]),
    // An open shell about a ball: two rings of the other body's colour.
    socket(g, at, [r], paint) {
      for (const axis of [[0, 0, 1], [0, 1, 0]]) {
        along(add(g, bevelled(r * 1.04, r * 0.9, r * 0.5), paint), at[0], vector(axis));
      }
    },
    block(g, at, sizes, paint) {
      const [length, width] = sizes, height = sizes[2] ?? width;
      box(g, at[0], at[1], at[2], [length, width * 2, sizes.length > 2 ? height * 1.5 : width * 2], paint);
    },
    rail(g, at, [r], paint) {
      const gap = at[1].clone().sub(at[0]), centre = at[0].clone().add(at[1]).multiplyScalar(0.5);
      box(g, centre, gap, at[2], [gap.length(), 2 * r, 2 * r], guide);
      for (const end of [at[0], at[1]]) box(g, end, gap, at[2], [1.2 * r, 3.2 * r, 3.2 * r], paint);
    },
    groundrail(g, at, [r]) {
      const gap = at[1].clone().sub(at[0]), centre = at[0].clone().add(at[1]).multiplyScalar(0.5);
      box(g, centre, gap, at[2], [gap.length(), 1.2 * r, 1.6 * r], dark);
      const count = Math.max(6, Math.round(gap.length() / (1.6 * r)));
      const side = at[2].clone().normalize(), direction = gap.clone().normalize();
      hatching(g, at[0].clone().addScaledVector(side, -0.6 * r), gap.clone().multiplyScalar(1 / count),
        side.clone().multiplyScalar(-1.6 * r).addScaledVector(direction, -1.2 * r), count + 1, ink);
    },
    disc: (g, at, [r, thick], paint) => along(add(g, bevelled(r, 0.0001 * r, thick), paint), at[0], at[1]),
    slab: (g, at, [r, thick], paint) => slab(g, at[0], at.slice(1), r, thick, paint),
    // A pivot of a planar ground: a foot with a hatched line under it.
    pivot(g, at, [r]) {
      const n = at[1].clone().normalize();
      const up = vector(data.up).addScaledVector(n, -vector(data.up).dot(n)).normalize();
      const side = up.clone().cross(n);
      const shape = new THREE.Shape();
      shape.moveTo(-2.2 * r, -2.7 * r);
      shape.lineTo(2.2 * r, -2.7 * r);
      shape.lineTo(0.8 * r, 0.3 * r);
      shape.absarc(0, 0.2 * r, 0.85 * r, 0, Math.PI, false);
      shape.closePath();
      const mesh = add(g, new THREE.ExtrudeGeometry(shape, { depth: 0.5 * r, bevelEnabled: true,
        bevelThickness: 0.06 * r, bevelSize: 0.06 * r, bevelSegments: 2, curveSegments: 18 }), dark);
      mesh.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(side, up, n));
      mesh.position.copy(at[0]).addScaledVector(n, -0.8 * r);
      const base = at[0].clone().addScaledVector(up, -2.8 * r).addScaledVector(n, -0.3 * r);
      const line = base.clone().addScaledVector(side, -3.2 * r);
      hatching(g, line, side.clone().multiplyScalar(0.72 * r),
        up.clone().multiplyScalar(-0.8 * r).addScaledVector(side, -0.7 * r), 10, ink);
      hatching(g, line, side, side.clone().multiplyScalar(6.4 * r), 1, ink);
    },
  };
  const groups = data.bodies.map((each, index) => {
    const group = new THREE.Group();
    group.userData = { body: index, paint: paints[index] };
    for (const shape of each.shapes) {
      DRAW[shape.kind](group, shape.at.map(vector), shape.sizes, paints[index]);
    }
    root.add(group);
    return group;
  });

  // ---- ground, floor and light --------------------------------------------------------------
  if (data.planar) {
    // A wall behind, for the shadows.
    const wall = new THREE.Mesh(new THREE.PlaneGeometry(40 * radius, 40 * radius),
      new THREE.ShadowMaterial({ opacity: 0.16 }));
    wall.position.set(middle.x, middle.y, bounds.low.z - 0.11 * L);
    wall.receiveShadow = true;
    scene.add(wall);
    sun.position.set(middle.x - 0.5 * radius, middle.y + 0.9 * radius, bounds.high.z + 2.6 * radius + 6 * L);
    fill.position.set(middle.x + radius, middle.y - radius, bounds.high.z + 2 * radius);
  } else {
    const low = Math.min(bounds.low.z - 0.12 * radius, middle.z - 0.9 * radius);
    const floor = new THREE.Mesh(new THREE.PlaneGeometry(60 * radius, 60 * radius),
      new THREE.ShadowMaterial({ opacity: 0.2 }));
    floor.position.set(middle.x, middle.y, low);
    floor.receiveShadow = true;
    scene.add(floor);
    const step = Math.pow(2, Math.round(Math.log2(radius / 3))), lines = [];
    for (let i = -24; i <= 24; i++) {
      lines.push(middle.x + i * step, middle.y - 24 * step, low, middle.x + i * step, middle.y + 24 * step, low);
      lines.push(middle.x - 24 * step, middle.y + i * step, low, middle.x + 24 * step, middle.y + i * step, low);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(lines, 3));
    scene.add(new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: "#e6e8e8" })));
    scene.fog = new THREE.Fog(PAPER, 5.9 * radius, 11 * radius);
    standOn(low);
    sun.position.set(middle.x + 1.2 * radius, middle.y - 1.5 * radius, middle.z + 3.2 * radius);
    fill.position.set(middle.x - 2 * radius, middle.y - radius, middle.z + radius);
  }
  sun.target.position.copy(middle);
  fill.target.position.copy(middle);
  const shade = sun.shadow.camera, reach = 1.7 * radius;
  shade.left = shade.bottom = -reach;
  shade.right = shade.top = reach;
  shade.near = 0.05 * radius;
  shade.far = 14 * radius + 20 * L;

  // Posts from the fixed body's joints to a base on the floor.
  function standOn(low) {
    const feet = [];
    for (const foot of data.feet) {
      const at = place(data.ground, vector(foot), 0, new Vector3());
      if (feet.every((p) => Math.hypot(p.x - at.x, p.y - at.y) > 0.12 * L)) feet.push(at.clone());
    }
    const stand = new THREE.Group();
    stand.userData.body = data.ground;
    const thick = 0.09 * L;
    for (const at of feet) {
      rod(stand, at, new Vector3(at.x, at.y, low + thick / 2), 0.034 * L, dark);
    }
    if (feet.length) {
      const points = feet.map((p) => new Vector3(p.x, p.y, low + thick / 2));
      slab(stand, new Vector3(0, 0, 1), points.length > 1 ? points : [points[0], points[0]], 0.2 * L, thick,
        material("#4a5563", { roughness: 0.8 }));
      // No hole in the base.
    }
    scene.add(stand);
  }

  // ---- paths of points ----------------------------------------------------------------------
  const paths = new THREE.Group();
  scene.add(paths);
  function drawPaths() {
    for (const child of [...paths.children]) {
      child.geometry.dispose();
      paths.remove(child);
    }
    for (const hub of hubs) {
      if (!hub.path) continue;
      const points = [];
      const count = Math.min(Math.max(last(), 120), 240);
      let length = 0;
      for (let i = 0; i <= count; i++) {
        const at = place(hub.body, hub.at, (i / count) * last(), new Vector3());
        if (points.length) length += at.distanceTo(points.at(-1));
        points.push(at);
      }
      if (length < 0.02 * L) continue;
      const apart = [points[0]];
      for (const p of points) if (p.distanceTo(apart.at(-1)) > 0.004 * length) apart.push(p);
      if (apart.length < 3) continue;
      const closed = circuit.closed && points[0].distanceTo(points.at(-1)) < 0.02 * length;
      if (closed && apart.at(-1).distanceTo(apart[0]) < 0.004 * length) apart.pop();
      const curve = new THREE.CatmullRomCurve3(apart, closed);
      const colour = new THREE.Color(COLOURS[hub.colour % COLOURS.length]);
      const paint = material(colour.lerp(new THREE.Color("#ffffff"), 0.12), { roughness: 0.8 });
      const mesh = new THREE.Mesh(new THREE.TubeGeometry(curve, 2 * apart.length, 0.0045 * radius + 0.0035 * L, 8, closed), paint);
      mesh.userData.path = true;
      paths.add(mesh);
    }
    paths.visible = $("paths").checked;
  }

  // ---- the view -----------------------------------------------------------------------------
  function resetView() {
    const aspect = stage.clientWidth / Math.max(stage.clientHeight, 1);
    const half = Math.tan((camera.fov * Math.PI) / 360) * Math.min(1, aspect * 0.92);
    const wide = bounds.high.clone().sub(bounds.low);
    if (data.planar) {
      const need = Math.max(wide.y / 2 + 0.35 * L, (wide.x / 2 + 0.4 * L) / Math.max(aspect, 0.5)) * 1.08;
      camera.up.set(0, 1, 0);
      const distance = need / Math.tan((camera.fov * Math.PI) / 360);
      camera.position.set(middle.x + 0.05 * distance, middle.y - 0.02 * distance, middle.z + distance);
    } else {
      camera.up.set(0, 0, 1);
      const distance = (1.3 * radius) / half;
      camera.position.copy(middle).add(new Vector3(0.46, -0.8, 0.4).normalize().multiplyScalar(distance));
    }
    camera.near = 0.02 * radius;
    camera.far = 60 * radius;
    camera.updateProjectionMatrix();
    controls.target.copy(middle);
    if (!data.planar) controls.target.z -= 0.03 * radius;
    controls.update();
  }
  function resize() {
    const { clientWidth: w, clientHeight: h } = stage;
    renderer.setSize(w, h, false);
    camera.aspect = w / Math.max(h, 1);
    camera.updateProjectionMatrix();
    drawChart();
  }

  // ---- names beside bodies ------------------------------------------------------------------
  const tags = data.bodies.map((each, index) => {
    const tag = document.createElement("div");
    tag.className = "tag";
    tag.textContent = each.name;
    tag.style.color = each.colour < 0 ? GROUND : COLOURS[each.colour % COLOURS.length];
    tag.hidden = true;
    stage.append(tag);
    return tag;
  });
  function placeTags() {
    const shown = $("names").checked;
    tags.forEach((tag, body) => {
      tag.hidden = !shown;
      if (!shown) return;
      place(body, vector(data.bodies[body].middle), frame, spot).project(camera);
      const x = ((spot.x + 1) / 2) * stage.clientWidth, y = ((1 - spot.y) / 2) * stage.clientHeight;
      tag.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    });
  }

  // ---- the chart ----------------------------------------------------------------------------
  const chart = $("chart"), pen = chart.getContext("2d");
  let series = [];
  function findSeries() {
    series = [];
    for (let c = 0; c < columns; c++) {
      const kind = data.coordinates[c].kind;
      const like = series.find((s) => s.kind === kind && Array.from({ length: circuit.frames }).every(
        (_, i) => Math.abs(circuit.values[s.columns[0] * circuit.frames + i] - circuit.values[c * circuit.frames + i]) < 1e-4));
      if (like) like.columns.push(c);
      else series.push({ kind, columns: [c], off: false });
    }
    series.forEach((s, i) => {
      s.colour = COLOURS[i % COLOURS.length];
      s.dash = DASHES[i % DASHES.length];
    });
    const legend = $("legend");
    legend.replaceChildren(...series.map((s) => {
      const row = document.createElement("div");
      row.title = "show or hide";
      const sample = document.createElement("canvas");
      sample.width = 52; sample.height = 12; sample.style.width = "26px"; sample.style.height = "6px";
      const brush = sample.getContext("2d");
      brush.scale(2, 2); brush.strokeStyle = s.colour; brush.lineWidth = 2.6; brush.setLineDash(s.dash);
      brush.beginPath(); brush.moveTo(0, 3); brush.lineTo(26, 3); brush.stroke();
      const name = document.createElement("span");
      name.className = "name"; name.textContent = s.columns.map((c) => data.coordinates[c].name).join(", ");
      s.shown = document.createElement("span");
      s.shown.className = "value";
      row.append(sample, name, s.shown);
      row.onclick = () => { s.off = !s.off; row.classList.toggle("off", s.off); drawChart(); };
      return row;
    }));
  }
  const box2 = { left: 52, right: 14, top: 8, bottom: 22 };
  const chartWidth = () => chart.clientWidth - box2.left - box2.right;
  function niceStep(span, kind) {
    if (kind === "angle") {
      for (const s of [1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720]) if (span / s <= 5) return s;
      return 1440;
    }
    const power = Math.pow(10, Math.floor(Math.log10(span / 4)));
    return [1, 2, 5, 10].map((m) => m * power).find((s) => span / s <= 5);
  }
  function range(kind) {
    let low = Infinity, high = -Infinity;
    for (const s of series) {
      if (s.kind !== kind || s.off) continue;
      for (let i = 0; i < circuit.frames; i++) {
        const v = circuit.values[s.columns[0] * circuit.frames + i];
        low = Math.min(low, v); high = Math.max(high, v);
      }
    }
    if (low > high) return null;
    if (high - low < 1e-6) { low -= 1; high += 1; }
    const step = niceStep(high - low, kind);
    const spare = 0.06 * (high - low);
    return { low: low - spare, high: high + spare, step };
  }
  function drawChart() {
    const ratio = window.devicePixelRatio || 1, w = chart.clientWidth, h = chart.clientHeight;
    chart.width = w * ratio; chart.height = h * ratio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, w, h);
    const ranges = { angle: range("angle"), slide: range("slide") };
    box2.right = ranges.slide && ranges.angle ? 48 : 14;
    const x = (i) => box2.left + (i / last()) * chartWidth();
    const y = (v, r) => box2.top + ((r.high - v) / (r.high - r.low)) * (h - box2.top - box2.bottom);
    pen.font = "11px system-ui, sans-serif";
    pen.textBaseline = "middle";
    for (const [kind, r] of Object.entries(ranges)) {
      if (!r) continue;
      const first = kind === "angle" || !ranges.angle;
      for (let v = Math.ceil(r.low / r.step) * r.step; v <= r.high; v += r.step) {
        if (first) {
          pen.strokeStyle = Math.abs(v) < r.step / 2 ? "#cfd3d7" : "#eceef0";
          pen.lineWidth = 1; pen.setLineDash([]);
          pen.beginPath(); pen.moveTo(box2.left, y(v, r)); pen.lineTo(w - box2.right, y(v, r)); pen.stroke();
        }
        pen.fillStyle = "#8b96a1";
        pen.textAlign = first ? "right" : "left";
        const text = kind === "angle" ? `${Math.round(v)}\u00b0` : String(+v.toPrecision(4));
        pen.fillText(text, first ? box2.left - 7 : w - box2.right + 7, y(v, r));
      }
    }
    pen.setLineDash([3, 4]); pen.strokeStyle = "#9aa4ad"; pen.lineWidth = 1;
    for (const crossing of circuit.crossings) {
      pen.beginPath(); pen.moveTo(x(crossing.at), box2.top); pen.lineTo(x(crossing.at), h - box2.bottom); pen.stroke();
    }
    for (const s of series) {
      if (s.off) continue;
      pen.strokeStyle = s.colour; pen.lineWidth = 1.9; pen.setLineDash(s.dash); pen.lineJoin = "round";
      pen.beginPath();
      // Few frames are joined by their cubics.
      const fine = Math.max(1, Math.ceil(240 / last())), places = fine * last();
      for (let i = 0; i <= places; i++) {
        const at = i / fine, v = y(value(s.columns[0], at), ranges[s.kind]);
        if (i) pen.lineTo(x(at), v); else pen.moveTo(x(at), v);
      }
      pen.stroke();
    }
    pen.setLineDash([]);
    for (const point of circuit.dead) {
      const s = series.find((each) => each.columns.includes(point.column));
      if (!s || s.off) continue;
      pen.fillStyle = "#fff"; pen.strokeStyle = s.colour; pen.lineWidth = 1.6;
      pen.beginPath(); pen.arc(x(point.at), y(point.value, ranges[s.kind]), 3, 0, 7); pen.fill(); pen.stroke();
    }
    pen.strokeStyle = "#1d2733"; pen.lineWidth = 1.3;
    pen.beginPath(); pen.moveTo(x(frame), 2); pen.lineTo(x(frame), h - box2.bottom + 3); pen.stroke();
    for (const s of series) {
      const v = value(s.columns[0], frame);
      s.shown.textContent = s.kind === "angle" ? `${(Math.round(10 * v) / 10 || 0).toFixed(1)}\u00b0` : (Math.abs(v) < 1e-9 ? 0 : v).toPrecision(4);
      if (s.off) continue;
      pen.fillStyle = s.colour; pen.strokeStyle = "#fff"; pen.lineWidth = 1.5;
      pen.beginPath(); pen.arc(x(frame), y(v, ranges[s.kind]), 4.4, 0, 7); pen.fill(); pen.stroke();
    }
    pen.fillStyle = "#8b96a1"; pen.textAlign = "center";
    pen.fillText(data.axis.replace("{length}", circuit.length), box2.left + chartWidth() / 2, h - 7);
  }
  let holding = false;
  const toFrame = (event) => {
    const at = (event.clientX - chart.getBoundingClientRect().left - box2.left) / chartWidth();
    show(Math.max(0, Math.min(1, at)) * last());
  };
  chart.addEventListener("pointerdown", (event) => {
    holding = true; stop(); toFrame(event);
    try { chart.setPointerCapture(event.pointerId); } catch { /* a pointer of a test's making */ }
  });
  chart.addEventListener("pointermove", (event) => { if (holding) toFrame(event); });
  chart.addEventListener("pointerup", () => { holding = false; });

  // ---- showing a frame ----------------------------------------------------------------------
  function show(at) {
    frame = Math.max(0, Math.min(last(), at));
    groups.forEach((group, body) => pose(body, frame, group.quaternion, group.position));
    $("scrub").value = String(Math.round(frame * 10));
    $("where").textContent = `${((100 * frame) / last()).toFixed(1)} % of the way, ${circuit.closed ? "closed" : "open"}`;
    drawChart();
  }
  const ICONS = { play: "M3 1l10 6-10 6z", pause: "M3 1h3v12H3zM8 1h3v12H8z" };
  let playing = false, backwards = false, before = null;
  function icon() {
    $("play").innerHTML = `<svg width="14" height="14" aria-hidden="true"><path fill="currentColor" d="${playing ? ICONS.pause : ICONS.play}"/></svg>`;
    $("play").setAttribute("aria-label", playing ? "pause" : "play");
  }
  function play() { playing = true; before = null; icon(); }
  function stop() { playing = false; icon(); }
  function advance(now) {
    const seconds = before === null ? 0 : Math.min((now - before) / 1000, 0.1);
    before = now;
    if (!playing) return;
    // A whole circuit takes eight seconds; an open one is run back and forth.
    let next = frame + (backwards ? -1 : 1) * seconds * Number($("speed").value) * (last() / 8);
    if (circuit.closed) next = ((next % last()) + last()) % last();
    else if (next >= last() || next <= 0) {
      backwards = next >= last();
      next = Math.max(0, Math.min(last(), next));
    }
    show(next);
  }
  // Of a driven joint the menu has the circuits at its value.
  function listCircuits() {
    const own = data.circuits.map((each, i) => [each, i])
      .filter(([each]) => !data.held || each.value === circuit.value);
    $("circuit").replaceChildren(...own.map(([each, i]) => new Option(each.label, String(i))));
    if (!data.held) return;
    $("drivescrub").value = String(circuit.value);
    $("drivevalue").textContent = data.held.values[circuit.value];
  }
  // The frame of a circuit in which all bodies are nearest to where they are.
  function nearestFrame(next) {
    const spots = hubs.map((hub) => place(hub.body, hub.at, Math.min(frame, last() - 1e-6), new Vector3()));
    const here = circuit;
    let best = 0, least = Infinity;
    circuit = next;
    for (let i = 0; i < next.frames; i++) {
      let away = 0;
      hubs.forEach((hub, k) => { away += place(hub.body, hub.at, Math.min(i, last() - 1e-6), spot).distanceToSquared(spots[k]); });
      if (away < least) { least = away; best = i; }
    }
    circuit = here;
    return best;
  }
  // The circuit that continues this one at another value, else the first one there.
  function driveTo(index) {
    const there = data.circuits.map((each, i) => [each, i]).filter(([each]) => each.value === index);
    if (!there.length) {
      $("drivevalue").textContent = `${data.held.values[index]}, no circuit`;
      return;
    }
    const [next, i] = there.find(([each]) => each.family === circuit.family) ?? there[0];
    const at = nearestFrame(next);
    choose(i);
    show(at);
  }
  function choose(index) {
    circuit = data.circuits[index];
    listCircuits();
    $("circuit").value = String(index);
    $("scrub").max = String(10 * last());
    backwards = false;
    findSeries();
    $("lower").hidden = !columns;
    drawPaths();
    listDead();
    show(0);
  }

  // ---- facts --------------------------------------------------------------------------------
  function listDead() {
    const own = circuit.facts.map(([name, text]) => {
      const dt = document.createElement("dt"), dd = document.createElement("dd");
      dt.textContent = name; dd.textContent = text;
      return [dt, dd];
    });
    const all = data.facts.map(([name, text]) => {
      const dt = document.createElement("dt"), dd = document.createElement("dd");
      dt.textContent = name; dd.textContent = text;
      return [dt, dd];
    });
    $("factlist").replaceChildren(...[...all, ...own].flat());
    const entries = [
      ...circuit.crossings.map((c) => [c.at, c.text]),
      ...circuit.dead.map((d) => [d.at, d.text]),
    ].sort((a, b) => a[0] - b[0]);
    $("special").hidden = !entries.length;
    $("dead").replaceChildren(...entries.map(([at, text]) => {
      const item = document.createElement("li"), button = document.createElement("button");
      button.textContent = text;
      button.onclick = () => { stop(); show(at); };
      item.append(button);
      return item;
    }));
  }

  // ---- dragging a link ----------------------------------------------------------------------
  const ray = new THREE.Raycaster(), pointer = new THREE.Vector2();
  let dragged = null;
  function aim(event) {
    const rect = renderer.domElement.getBoundingClientRect();
    pointer.set(((event.clientX - rect.left) / rect.width) * 2 - 1, 1 - ((event.clientY - rect.top) / rect.height) * 2);
  }
  function pick(event) {
    aim(event);
    ray.setFromCamera(pointer, camera);
    const hit = ray.intersectObjects(groups, true).find((h) => h.object.userData.body !== undefined);
    if (!hit) return null;
    const body = hit.object.userData.body;
    if (body === data.ground) return null;
    return { body, local: groups[body].worldToLocal(hit.point.clone()) };
  }
  renderer.domElement.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    dragged = pick(event);
    if (!dragged) return;
    stop();
    controls.enabled = false;
    renderer.domElement.style.cursor = "grabbing";
  }, { capture: true });
  window.addEventListener("pointermove", (event) => {
    if (!dragged) {
      if (event.target === renderer.domElement && !event.buttons) {
        renderer.domElement.style.cursor = pick(event) ? "grab" : "default";
      }
      return;
    }
    aim(event);
    const aspect = camera.aspect, reachable = Math.max(4, last() * 0.11);
    let best = frame, least = Infinity;
    // Places near by along the motion, so that the link does not leap over a crossing of its path;
    // then those between the nearest of them.
    for (const [around, step] of [[() => frame, reachable / 40], [() => best, reachable / 800]]) {
      const centre = around();
      for (let k = -40; k <= 40; k++) {
        let at = centre + k * step;
        if (circuit.closed) at = ((at % last()) + last()) % last();
        else at = Math.max(0, Math.min(last(), at));
        place(dragged.body, dragged.local, at, spot).project(camera);
        const away = Math.hypot((spot.x - pointer.x) * aspect, spot.y - pointer.y) + 1e-5 * Math.abs(k);
        if (away < least) { least = away; best = at; }
      }
    }
    show(best);
  });
  window.addEventListener("pointerup", () => {
    if (!dragged) return;
    dragged = null;
    controls.enabled = true;
    renderer.domElement.style.cursor = "default";
  });

  // ---- tables to take away ------------------------------------------------------------------
  function csv() {
    const head = ["circuit", "arc", ...data.coordinates.map((c) => c.name)];
    for (const each of data.bodies) head.push(...["x", "y", "z", "q0", "q1", "q2", "q3"].map((k) => `${each.name}.${k}`));
    const quote = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const lines = [head.map(quote).join(",")];
    for (let i = 0; i < circuit.frames; i++) {
      const row = [circuit.number, (circuit.arc * i) / last()];
      for (let c = 0; c < columns; c++) row.push(circuit.values[c * circuit.frames + i]);
      for (let b = 0; b < bodies; b++) {
        const k = b * circuit.frames + i;
        row.push(...circuit.places.slice(3 * k, 3 * k + 3), ...circuit.turns.slice(4 * k, 4 * k + 4));
      }
      lines.push(row.map((v, j) => (j ? Number(v.toPrecision(7)) : v)).join(","));
    }
    return lines.join("\n") + "\n";
  }
  $("csv").onclick = () => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([csv()], { type: "text/csv" }));
    link.download = `${data.file}-circuit-${circuit.number}.csv`;
    link.click();
    URL.revokeObjectURL(link.href);
  };

  // ---- controls -----------------------------------------------------------------------------
  if (data.held) {
    $("drive").hidden = false;
    $("drivename").textContent = data.held.name;
    $("drivescrub").max = String(data.held.values.length - 1);
    $("drivescrub").oninput = () => driveTo(Number($("drivescrub").value));
  }
  $("circuit").onchange = () => choose(Number($("circuit").value));
  $("play").onclick = () => (playing ? stop() : play());
  $("scrub").oninput = () => { stop(); show(Number($("scrub").value) / 10); };
  $("paths").onchange = () => { paths.visible = $("paths").checked; };
  $("names").onchange = placeTags;
  const speeds = [...$("speed").options].map((o) => o.value);
  const changeSpeed = (by) => {
    const i = speeds.indexOf($("speed").value) + by;
    if (i >= 0 && i < speeds.length) $("speed").value = speeds[i];
  };
  const KEYS = {
    " ": () => (playing ? stop() : play()),
    ArrowRight: () => { stop(); show(frame + 1 > last() && circuit.closed ? 0 : frame + 1); },
    ArrowLeft: () => { stop(); show(frame - 1 < 0 && circuit.closed ? last() : frame - 1); },
    Home: () => { stop(); show(0); },
    End: () => { stop(); show(last()); },
    "+": () => changeSpeed(1),
    "-": () => changeSpeed(-1),
    c: () => choose((data.circuits.indexOf(circuit) + 1) % data.circuits.length),
    n: () => { $("names").click(); },
    p: () => { $("paths").click(); },
    t: () => { $("turn").click(); },
    r: resetView,
  };
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /SELECT/.test(event.target.tagName)) return;
    if (event.target.type === "range" && /Arrow|Home|End/.test(event.key)) return;
    if (event.key === " " && event.target.tagName === "BUTTON") return;
    const act = KEYS[event.key];
    if (act) { event.preventDefault(); act(); }
  });
  new ResizeObserver(() => { resize(); if (!touched) resetView(); }).observe(stage);
  let touched = false;
  controls.addEventListener("start", () => { touched = true; });

  // A page that nobody looks at, as in a test, gets no frames but by a timer.
  const nextFrame = location.hash === "#test"
    ? (draw) => setTimeout(() => draw(performance.now()), 250) : requestAnimationFrame;
  function tick(now) {
    advance(now);
    controls.autoRotate = $("turn").checked;
    controls.autoRotateSpeed = 1.4;
    controls.update();
    placeTags();
    renderer.render(scene, camera);
    nextFrame(tick);
  }
  resize();
  resetView();
  choose(0);
  stop();
  show(0);
  nextFrame(tick);

  window.nagPage = { data, show, play, stop, choose, driveTo, csv, at: () => frame, pick, place, camera, groups, renderer,
    circuit: () => circuit };
})();
