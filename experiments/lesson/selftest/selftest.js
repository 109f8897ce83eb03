// The tests of the page, run by the page: `lesson.html#selftest`. Test files register functions; the result stands in
// the page as "N passed, M failed", where a person or a headless browser reads it. `#selftest/short` takes a quarter of
// the cases of the tests that take longest.
Lesson.selftest = (() => {
  const tests = [];
  const failures = [];
  const notes = [];  // measured, not judged
  let passed = 0;
  let current = "";

  const isShort = window.location.hash.endsWith("/short");
  // How many of so many cases a test takes.
  const cases = (count) => isShort ? Math.ceil(count / 4) : count;

  const test = (name, run) => tests.push({name, run});

  // Every check counts; a failing one tells its test and its case.
  const check = (isSo, what) => {
    if (isSo)
      passed += 1;
    else
      failures.push(`${current}: ${what}`);
    return isSo;
  };

  const equal = (actual, expected, what) => {
    const [a, b] = [JSON.stringify(actual), JSON.stringify(expected)];
    return check(a === b, a === b ? "" : `${what}: ${a.slice(0, 200)} instead of ${b.slice(0, 200)}`);
  };

  const runAll = async (report) => {
    for (const {name, run} of tests) {
      current = name;
      const begin = performance.now();
      const before = failures.length;
      report(`${name} …`);
      // The page shows where it is before a test takes its time.
      await new Promise((resolve) => setTimeout(resolve, 0));
      try {
        await run();
      } catch (error) {
        failures.push(`${name}: ${error.stack}`);
      }
      const time = `${(performance.now() - begin).toFixed(0)} ms`;
      report(`${failures.length === before ? "passed" : "FAILED"}: ${name}, ${time}`, true);
    }
  };

  // Until the tests are over the page counts as loading: a browser without a screen waits for that, by a real clock,
  // before it tells what the page has become. A document within it that was opened and not closed does it.
  const delayLoading = () => {
    const inner = Lesson.element("iframe", {hidden: true});
    document.body.append(inner);
    inner.contentDocument.open();
    return () => inner.contentDocument.close();
  };

  // A page of the tests' own, out of sight but as large as a screen. One for all, as each would get the keys.
  let testPage = null;
  const page = () => {
    if (testPage) return testPage;
    const root = Lesson.element("div", {style: "position: absolute; left: -3000px; top: 0; width: 1280px"});
    document.body.append(root);
    testPage = new Lesson.Page(root);
    return testPage;
  };

  const run = async (root) => {
    const {element} = Lesson;
    const finishLoading = delayLoading();
    const result = element("p", {id: "selftest-result", role: "status"}, "running");
    const list = element("ol", {});
    root.replaceChildren(element("main", {class: "plain"}, element("h1", {}, "Self-test"), result, list));
    const begin = performance.now();
    await runAll((text, isDone) => {
      if (isDone)
        list.append(element("li", {}, text));
      else
        result.textContent = `running: ${text}`;
    });
    for (const failure of failures.slice(0, 50)) list.append(element("li", {class: "failure"}, failure));
    result.textContent = `${passed} passed, ${failures.length} failed`;
    list.after(...notes.map((note) => element("p", {class: "soft"}, note)));
    result.after(element(
        "p", {class: "soft"},
        `${((performance.now() - begin) / 1000).toFixed(1)} seconds, ` +
            `${tests.length} tests, seed ${Lesson.data.seed}`));
    finishLoading();
  };

  return {test, check, equal, cases, page, run, runAll, failures, notes, passed: () => passed};
})();
