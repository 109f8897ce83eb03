// The chapter of the coding lab: a task, a place to write, and what is wrong, in words and as a picture.
Lesson.CodingLab = class {
  constructor(seed) {
    this.name = "coding";
    this.title = "Coding";
    this.seed = seed;
    this.codes = new Map(Lesson.codingTasks.map((task) => [task.name, task.skeleton]));
    this.solved = new Set();
    this.task = Lesson.codingTasks[0];
  }

  // The frame shows this instead of a picture with steps.
  page() {
    const {element} = Lesson;
    this.tabs = element("nav", {"aria-label": "tasks"});
    this.statement = element("p", {});
    this.input = element("textarea", {
      class: "program",
      rows: 13,
      spellcheck: "false",
      autocapitalize: "off",
      "aria-label": "your function",
      oninput: () => this.codes.set(this.task.name, this.input.value),
    });
    this.result = element("p", {class: "score", role: "status"});
    this.details = element("pre", {class: "details"});
    this.canvas = element("canvas", {class: "counterexample", role: "img", "aria-label": "the case that is wrong"});
    const begin = element("button", {onclick: () => this.reset()}, "Begin again");
    this.button = element("button", {class: "check", onclick: () => this.check()}, "Check");
    const page = element(
        "div", {class: "coding"},
        element(
            "div", {}, this.tabs, this.statement, this.input, element("div", {class: "controls"}, this.button, begin)),
        element("div", {}, this.result, this.details, this.canvas));
    this.showTask();
    return page;
  }

  show(rest) {
    this.task = Lesson.codingTasks.find((task) => task.name === rest) ?? this.task;
    this.showTask();
  }

  // Dark or light has changed, or the size.
  redraw() {
    if (this.shown) this.draw();
  }

  showTask() {
    this.tabs.replaceChildren(...Lesson.codingTasks.map(
        (task) => Lesson.element(
            "a", {href: `#coding/${task.name}`, "aria-current": task === this.task ? "page" : null},
            `${task.title}${this.solved.has(task.name) ? " ✓" : ""}`)));
    this.statement.textContent = this.task.statement;
    this.input.value = this.codes.get(this.task.name);
    // The first instance and its answer say in one glance what the task is.
    const [instance] = Lesson.judge.instancesOf(this.task, this.seed);
    this.result.textContent = `The first of the instances (seed ${this.seed}):`;
    this.showCase({instance, right: this.task.answer(instance)});
  }

  reset() {
    this.codes.set(this.task.name, this.task.skeleton);
    this.showTask();
  }

  async check() {
    this.button.disabled = true;
    this.result.textContent = "Running …";
    const {task} = this;
    const verdict = await Lesson.judge.judge(task, this.input.value, this.seed);
    this.button.disabled = false;
    if (task === this.task) this.showVerdict(verdict);
  }

  showVerdict({passed, total, error, case: wrong}) {
    if (error) {
      this.result.textContent = `It does not run: ${error}`;
    } else if (!wrong) {
      this.solved.add(this.task.name);
      this.showTask();
      this.result.textContent = `All ${total} instances are right.`;
    } else {
      this.result.textContent =
          `${passed} of ${total} instances are right. The first that is not is number ${wrong.index + 1}:`;
      this.showCase(wrong);
    }
  }

  // An instance with the right answer and, after a check, the student's.
  showCase(shown) {
    this.shown = shown;
    this.details.textContent = this.explain(shown);
    this.draw();
  }

  explain({instance, given, right, error, index}) {
    const short = (value) => {
      const text = JSON.stringify(value, (_, x) => (typeof x === "number" ? Number(x.toFixed(6)) : x)) ?? String(value);
      return text.length > 300 ? `${text.slice(0, 300)} …` : text;
    };
    const values = instance.arguments.map(short).join(", ");
    const rows = [`${this.task.name}(${values})`, "", `ought to return  ${short(right)}`];
    if (error)
      rows.push(`yours threw      ${error}`);
    else if (index !== undefined)
      rows.push(`yours returned   ${short(given)}`);
    return rows.join("\n");
  }

  draw() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (width === 0) return;
    const {instance, given, right} = this.shown;
    const scene = this.task.picture(instance, given, right);
    const view = new Lesson.View(scene.bounds, width, height);
    Lesson.paint(
        scene, view, new Lesson.CanvasPainter(Lesson.sizedContext(this.canvas, width, height)),
        {layers: null, dark: Lesson.theme.isDark()});
  }
};

Lesson.preparations.push(() => Lesson.chapters.push(new Lesson.CodingLab(Lesson.data.seed)));
