// Run for "#test": plays, scrubs and drags by events of its own making, and writes what it saw to
// the attribute data-seen of the page.
(() => {
  "use strict";
  const seen = { messages: [] };
  window.addEventListener("error", (event) => seen.messages.push(String(event.message)));
  for (const level of ["error", "warn", "log", "info"]) {
    const before = console[level].bind(console);
    console[level] = (...words) => { seen.messages.push(words.map(String).join(" ")); before(...words); };
  }
  if (location.hash !== "#test") return;
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const $ = (id) => document.getElementById(id);
  window.addEventListener("load", async () => {
    try {
      await wait(300);
      const page = window.nagPage, canvas = page.renderer.domElement;
      const positions = () => page.groups.map((g) => g.position.toArray().concat(g.quaternion.toArray())).flat();
      const differ = (a, b) => a.some((x, i) => Math.abs(x - b[i]) > 1e-9);
      seen.circuits = page.data.circuits.length;
      const start = positions();
      $("play").click();
      await wait(900);
      seen.played = page.at() > 0 && differ(start, positions());
      $("play").click();
      const stopped = page.at();
      await wait(150);
      seen.stopped = page.at() === stopped;
      const scrub = $("scrub");
      scrub.value = String(Number(scrub.max) / 4);
      scrub.dispatchEvent(new Event("input"));
      seen.scrubbed = Math.abs(page.at() - Number(scrub.max) / 40) < 0.2;
      // The chart's cursor.
      const chart = $("chart"), rect = chart.getBoundingClientRect();
      const point = (target, type, x, y) => target.dispatchEvent(new PointerEvent(type,
        { clientX: x, clientY: y, button: 0, buttons: 1, bubbles: true, pointerId: 1, isPrimary: true }));
      point(chart, "pointerdown", rect.left + rect.width / 2, rect.top + 20);
      point(chart, "pointermove", rect.left + rect.width * 0.55, rect.top + 20);
      point(chart, "pointerup", rect.left + rect.width * 0.55, rect.top + 20);
      seen.charted = Math.abs(page.at() / (Number(scrub.max) / 10) - 0.55) < 0.08;
      // A link: where the ray meets one that moves, dragged to where that point is a little later.
      const area = canvas.getBoundingClientRect();
      await wait(100);
      seen.dragged = false;
      search: for (let i = 1; i < 80; i++) {
        for (let j = 1; j < 60; j++) {
          const x = area.left + (area.width * i) / 80, y = area.top + (area.height * j) / 60;
          if (document.elementFromPoint(x, y) !== canvas) continue;
          const hit = page.pick({ clientX: x, clientY: y });
          if (!hit) continue;
          const from = page.at(), to = page.camera.position.clone();
          let tx = x, ty = y;
          // Of what is drawn small the place further ahead, which is within reach as well.
          for (const share of [1 / 24, 1 / 12]) {
            if (Math.hypot(tx - x, ty - y) >= 6) break;
            page.place(hit.body, hit.local, from + Number(scrub.max) / 10 * share, to).project(page.camera);
            tx = area.left + ((to.x + 1) / 2) * area.width;
            ty = area.top + ((1 - to.y) / 2) * area.height;
          }
          const way = Math.hypot(tx - x, ty - y);
          if (way < 6) continue;
          point(canvas, "pointerdown", x, y);
          for (let k = 1; k <= 6; k++) point(canvas, "pointermove", x + ((tx - x) * k) / 6, y + ((ty - y) * k) / 6);
          point(canvas, "pointerup", tx, ty);
          // The point that was picked is under the pointer, and was not before.
          page.place(hit.body, hit.local, page.at(), to).project(page.camera);
          const x1 = area.left + ((to.x + 1) / 2) * area.width, y1 = area.top + ((1 - to.y) / 2) * area.height;
          seen.dragged = page.at() !== from && Math.hypot(x1 - tx, y1 - ty) < way / 3;
          break search;
        }
      }
      // Keys.
      const key = (name) => window.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
      key("Home");
      const home = page.at();
      key("ArrowRight");
      seen.keys = home === 0 && page.at() === 1;
      if (page.data.held) {
        page.choose(0);
        const driver = $("drivescrub"), value = page.data.circuits.at(-1).value;
        driver.value = String(value);
        driver.dispatchEvent(new Event("input"));
        seen.driven = !driver.closest("label").hidden && page.circuit().value === value;
      }
      page.choose(page.data.circuits.length - 1);
      seen.chosen = page.circuit().number === page.data.circuits.at(-1).number;
      seen.rows = page.csv().trim().split("\n").length - 1;
      seen.frames = page.circuit().frames;
      seen.requests = performance.getEntriesByType("resource").length;
      page.show(0);
      await wait(100);
      const pixels = document.createElement("canvas");
      pixels.width = 96; pixels.height = 64;
      const pen = pixels.getContext("2d");
      pen.drawImage(canvas, 0, 0, 96, 64);
      seen.colours = new Set(new Uint32Array(pen.getImageData(0, 0, 96, 64).data.buffer)).size;
    } catch (error) {
      seen.messages.push(`the test stopped: ${error.stack}`);
    }
    document.documentElement.dataset.seen = JSON.stringify(seen);
  });
})();
