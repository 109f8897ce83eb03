// The page as its readers use it: by keys, by the pointer, by addresses. Every chapter with steps is played forward,
// backward and by address, and has to show the same each time.
(() => {
  const {test, check, equal, cases} = Lesson.selftest;
  let page = null;
  const open = () => (page = Lesson.selftest.page());

  const press = (key, more = {}) =>
      document.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true, ...more}));

  const goTo = (address) => open().showAddress(address);

  // All that a reader gets to see or hear of a state.
  const seen = () => {
    const {cards, live, player, stage} = page;
    const svg = Lesson.svgOf(stage.scene(), "", {layers: player.layers});
    return [
      player.step, live.textContent, cards.now.textContent, cards.next.textContent, cards.why.textContent,
      cards.code.querySelector(".lit")?.textContent ?? "", svg
    ];
  };

  const stepped = () => Lesson.chapters.filter((chapter) => !chapter.page);

  const kMostSteps = cases(130);

  // What lies beyond the steps that are played: by address, and again after a walk to the end.
  const checkFarSteps = (chapter, from) => {
    const end = page.player.last();
    if (end <= from) return;
    const far = [0.2, 0.5, 0.9].map((share) => Math.round(from + share * (end - from)));
    // What ends a run is of other kinds.
    for (let step = Math.max(from, end - 4); step <= end; ++step) far.push(step);
    const states = far.map((step) => {
      goTo(`#${chapter.name}/${step}`);
      return seen();
    });
    press("End");
    for (let i = far.length; i-- > 0;) {
      goTo(`#${chapter.name}/${far[i]}`);
      equal(seen(), states[i], `${chapter.name}/${far[i]} again`);
    }
  };

  // Steps spread over a chapter.
  const someSteps = (chapter, most) => {
    const count = chapter.steps().length;
    const stride = Math.max(1, Math.ceil(count / most));
    return Array.from({length: Math.ceil(count / stride)}, (_, i) => i * stride);
  };

  test("forward, backward and by address all is the same", () => {
    open();
    for (const chapter of stepped()) {
      goTo(`#${chapter.name}/0`);
      // Runs of thousands of steps are played for a while, and looked at by address.
      const last = Math.min(page.player.last(), kMostSteps);
      const forward = [seen()], times = [];
      while (page.player.step < last) {
        const begin = performance.now();
        press("ArrowRight");
        times.push(performance.now() - begin);
        forward.push(seen());
      }
      check(forward.length === last + 1, `${chapter.name}: ${forward.length} states`);
      check(new Set(forward.map(String)).size === forward.length, `${chapter.name}: two steps look alike`);
      for (let step = last; step >= 0; --step) {
        equal(seen(), forward[step], `${chapter.name}/${step} backward`);
        press("ArrowLeft");
      }
      for (let k = 0; k < cases(60); ++k) {
        const step = (k * 37) % (last + 1);
        goTo(`#${chapter.name}/${step}`);
        equal(seen(), forward[step], `${chapter.name}/${step} by address`);
      }
      checkFarSteps(chapter, last);
      if (last === 0) continue;
      times.sort((s, t) => s - t);
      const [median, most] = [times[times.length >> 1], times[times.length - 1]];
      Lesson.selftest.notes.push(
          `${chapter.name}: ${last} steps, ${median.toFixed(1)} ms a step (median), ` +
          `${most.toFixed(1)} ms the longest; ${chapter.milliseconds?.toFixed(0) ?? "–"} ms for the run`);
    }
  });

  test("keys do what the help says", () => {
    open();
    for (const chapter of stepped()) {
      goTo(`#${chapter.name}/0`);
      const {player} = page;
      const steps = chapter.steps();
      press("End");
      equal(player.step, player.last(), "End");
      press("Home");
      equal(player.step, 0, "Home");
      // Of a chapter without steps but the first, that is the last, too.
      const from = Math.min(1, player.last());
      goTo(`#${chapter.name}/${from}`);
      press("ArrowRight", {shiftKey: true});
      const to = steps.findIndex((step, i) => i > from && step.kind === steps[from].kind);
      equal(player.step, to < 0 ? player.last() : to, "Shift and the right arrow");
      for (const layer of Object.keys(chapter.layers)) {
        const isOn = player.layers.has(Number(layer));
        press(layer);
        check(player.layers.has(Number(layer)) !== isOn, `layer ${layer} off and on`);
        press(layer);
      }
      press("t");
      press("t");
      const isHandled = !press("ArrowRight");
      check(isHandled, "arrows do not scroll the page");
      goTo(`#${chapter.name}/0`);
      const pressIn = (element, key) => element.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true}));
      pressIn(page.cards.layers.querySelector("input"), "ArrowRight");
      equal(player.step, from, "arrows work while a layer's box has the focus");
      const number = Lesson.element("input", {type: "number"});
      page.panel.append(number);
      pressIn(number, "ArrowRight");
      equal(player.step, from, "a number keeps its keys");
      number.remove();
      if (page.panel.querySelector(".exercise")) {
        press("e");
        check(document.activeElement?.closest(".exercise"), `${chapter.name}: E goes to the exercise`);
        document.activeElement.blur();
      }
      press(" ");
      player.pause();
    }
  });

  test("predict mode hides what comes, and counts", () => {
    open();
    for (const chapter of stepped()) {
      goTo(`#${chapter.name}/0`);
      const {player} = page;
      player.predict.restart();
      press("p");
      const last = Math.min(player.last(), cases(40));
      let right = 0, asked = 0;
      for (let step = 0; step < last; ++step) {
        const {kind} = chapter.steps()[step + 1];
        const {sentence} = chapter.next(step);
        const shown = () => page.live.textContent + page.cards.next.textContent;
        // No answer would be right.
        if (!chapter.kinds[kind].key) {
          check(
              shown().includes(sentence) && !page.cards.why.hidden, `step ${step}: ${kind} has no key, and is hidden`);
          check(!page.cards.next.querySelector(".answers"), `step ${step}: ${kind} has no key, and is asked for`);
          press("ArrowRight");
          continue;
        }
        check(!shown().includes(sentence) && page.cards.why.hidden, `step ${step}: what comes is shown`);
        const others = Object.keys(chapter.kinds).filter((other) => chapter.kinds[other].key && other !== kind);
        const guess = step % 3 ? kind : others[step % others.length];
        press(chapter.kinds[guess].key);
        asked += 1;
        right += guess === kind ? 1 : 0;
        check(
            shown().includes(sentence) && !page.cards.why.hidden,
            `step ${step}: what comes is hidden after the answer`);
        // A second answer does not count.
        press(chapter.kinds[kind].key);
        equal(player.predict.scoreText(), `${right} of ${asked} right`, `step ${step}`);
        equal(player.step, step, "an answer is no step");
        press("ArrowRight");
      }
      press("p");
    }
  });

  // Counts what is drawn and keeps nothing.
  const nowhere = {path() {}, circle() {}, text() {}};

  test("labels do not cover each other", () => {
    open();
    for (const chapter of stepped()) {
      for (const step of someSteps(chapter, cases(150))) {
        const scene = chapter.scene(step, {preview: true});
        for (const [width, height] of [[840, 552], [390, 320]]) {
          const view = new Lesson.View(scene.bounds, width, height);
          const boxes = Lesson.paint(scene, view, nowhere, {layers: null, dark: false}).map((label) => label.box);
          const covered = boxes.some(
              (a, i) => boxes.slice(i + 1).some(
                  (b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom));
          const outside = boxes.some((b) => b.left < 0 || b.top < 0 || b.right > width || b.bottom > height);
          check(!covered && !outside, `${chapter.name}/${step} at ${width}x${height}`);
        }
      }
    }
  });

  test("pictures are SVG files that can be read", () => {
    open();
    for (const chapter of stepped()) {
      for (const step of someSteps(chapter, cases(20))) {
        const svg = Lesson.svgOf(chapter.scene(step, {preview: true}), chapter.sentence(step), {dark: step % 2 === 0});
        const parsed = new DOMParser().parseFromString(svg, "image/svg+xml");
        check(!parsed.querySelector("parsererror") && !svg.includes("NaN"), `${chapter.name}/${step}`);
        equal(parsed.querySelector("title").textContent, chapter.sentence(step), `${chapter.name}/${step}`);
      }
    }
  });

  test("the page names no address outside of it", () => {
    const sources = [...document.querySelectorAll("script, style")].map((element) => element.textContent).join("\n");
    const addresses =
        (sources.match(/https?:[^"'\s`]*/g) ?? []).filter((text) => !text.startsWith("http://www.w3.org/2000/svg"));
    check(addresses.every((text) => text.includes("[^")), `addresses: ${addresses}`);
    equal(document.querySelectorAll("script[src], link[href], img[src]").length, 0, "elements that load something");
  });

  test("every control has a name", () => {
    open();
    for (const chapter of Lesson.chapters) {
      goTo(`#${chapter.name}`);
      for (const control of page.stepped.parentNode.querySelectorAll(
               "button, input, select, textarea, [role=slider]")) {
        const name = control.getAttribute("aria-label") ?? control.closest("label")?.textContent ?? control.textContent;
        check(name.trim() !== "", `${chapter.name}: ${control.outerHTML.slice(0, 80)}`);
      }
    }
  });
})();
