// The page around the chapters: builds its elements once, then shows whatever state the address names. Chapters
// register themselves (README.md tells what one has to have).
Lesson.chapters = [];

Lesson.Page = class {
  constructor(root) {
    this.players = new Map();
    this.stage = new Lesson.Stage();
    this.timeline = new Lesson.Timeline((step) => this.player?.goTo(step));
    this.build(root);
    window.addEventListener("hashchange", () => this.showAddress());
    window.addEventListener("resize", () => {
      this.showTab();
      this.draw();
    });
    document.addEventListener("keydown", (event) => this.key(event));
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redress());
    this.showAddress();
  }

  build(root) {
    const {element} = Lesson;
    this.tabs = element("nav", {"aria-label": "chapters"});
    this.live = element("p", {class: "unseen", "aria-live": "polite"});
    this.cards = {};
    for (const name of ["now", "next", "why", "code", "layers"]) {
      this.cards[name] = element("section", {class: `card ${name}`});
    }
    this.panel = element("div", {class: "panel"});
    const button = (text, label, command) => element(
        "button", {"aria-label": label, title: label, "data-command": command, onclick: () => this.command(command)},
        text);
    const zooms = [["+", "larger", 1.3], ["−", "smaller", 1 / 1.3], ["□", "the whole picture", null]].map(
        ([text, label, factor]) =>
            element("button", {"aria-label": label, title: label, onclick: () => this.stage.zoom(factor)}, text));
    this.controls = element(
        "div", {class: "controls"}, button("|◀", "to the start", "first"), button("◀", "step back", "back"),
        button("▶", "next step", "next"), button("▶|", "to the end", "last"), button("Play", "play or pause", "play"),
        button("Predict", "predict the kind of the next step", "predict"));
    this.legend = element("p", {class: "legend"});
    this.stepped = element(
        "main", {class: "stepped"},
        element(
            "div", {class: "left"},
            element("div", {class: "picture"}, this.stage.canvas, element("div", {class: "zooms"}, ...zooms)),
            this.timeline.canvas, this.legend, this.controls),
        element("div", {class: "right"}, ...Object.values(this.cards), this.panel));
    this.plain = element("main", {class: "plain"});
    this.help = this.buildHelp();
    root.append(
        element(
            "header", {},
            element("button", {class: "skip", onclick: () => this.skip()}, "Skip the chapters: to the steps"),
            element("strong", {}, Lesson.data.title), this.tabs, button("SVG", "save the picture as SVG", "svg"),
            button("◐", "dark or light", "theme"), button("?", "keys", "help")),
        this.live, this.stepped, this.plain, this.help, Lesson.glossary.tip);
  }

  // What is shown of the chapter.
  root() { return this.player ? this.stepped : this.plain; }

  // For those who come by the keyboard.
  skip() {
    if (this.player) return this.timeline.canvas.focus();
    return this.plain.querySelector("a, button, input, textarea, dfn")?.focus();
  }

  buildHelp() {
    const {element} = Lesson;
    const rows = Lesson.keyboard.table.map(
        (row) => element("tr", {}, element("td", {}, element("kbd", {}, row.help)), element("td", {}, row.does)));
    rows.push(
        element("tr", {}, element("td", {}, element("kbd", {}, "1 … 9")), element("td", {}, "layers on and off")));
    return element(
        "dialog", {"aria-label": "keys"}, element("h2", {}, "Keys"), element("table", {}, ...rows),
        element("button", {onclick: () => this.help.close()}, "Close"));
  }

  showAddress(hash = window.location.hash) {
    Lesson.address.forget();
    const {chapter: name, step, rest} = Lesson.address.parse(hash);
    const chapter = Lesson.chapters.find((other) => other.name === name) ?? Lesson.chapters[0];
    if (chapter !== this.chapter) this.open(chapter);
    if (this.player) {
      if (step !== null && step !== this.player.step)
        this.player.goTo(step);
      else
        this.draw();
    } else if (chapter.show) {
      chapter.show(rest);
      this.explain(this.plain);
    }
  }

  // Words of the glossary at their first use: in what is shown of the chapter.
  explain(...roots) {
    Lesson.glossary.hide();
    const seen = new Set();
    for (const root of roots) Lesson.glossary.mark(root, seen, this.chapter.otherWords);
  }

  open(chapter) {
    this.player?.pause();
    this.chapter = chapter;
    // The tabs stay, so that the focus does.
    if (this.tabs.children.length !== Lesson.chapters.length)
      this.tabs.replaceChildren(
          ...Lesson.chapters.map((other) => Lesson.element("a", {href: `#${other.name}`}, other.title)));
    Lesson.chapters.forEach((other, i) => {
      if (other === chapter)
        this.tabs.children[i].setAttribute("aria-current", "page");
      else
        this.tabs.children[i].removeAttribute("aria-current");
    });
    this.showTab();
    this.player = null;
    this.stepped.hidden = Boolean(chapter.page);
    this.plain.hidden = !chapter.page;
    document.querySelector("[data-command=svg]").hidden = Boolean(chapter.page);
    if (chapter.page) {
      this.plain.replaceChildren(chapter.page());
      this.explain(this.plain);
      return;
    }
    if (!this.players.has(chapter)) {
      const player = new Lesson.Player(chapter, () => this.draw());
      this.players.set(chapter, player);
      chapter.open?.({rerun: () => player.rerun(), redraw: () => this.stage.draw()});
    }
    this.player = this.players.get(chapter);
    this.panel.replaceChildren(...(chapter.panel ? [chapter.panel()] : []));
  }

  // On a narrow screen the tabs are a strip; the current one stands in its middle.
  showTab() {
    const tab = this.tabs.querySelector("[aria-current]");
    this.tabs.scrollLeft = tab.offsetLeft - this.tabs.offsetLeft - (this.tabs.clientWidth - tab.offsetWidth) / 2;
  }

  draw() {
    if (!this.player) return this.chapter.redraw?.();
    const {chapter, step, predict, layers} = this.player;
    const hides = this.player.hidesNext();
    const hadFocus = this.cards.next.contains(document.activeElement);
    Lesson.address.show(chapter.name, step);
    this.stage.show(this.player);
    Lesson.cards.now(this.cards.now, chapter, step);
    if (hides)
      Lesson.cards.question(this.cards.next, chapter, step, predict, (kind) => this.player.answer(kind));
    else
      Lesson.cards.next(this.cards.next, chapter, step);
    this.showResult(predict, chapter, step);
    if (hadFocus) this.keepFocus();
    this.cards.why.hidden = hides;
    const next = chapter.next(step);
    Lesson.cards.why(this.cards.why, next && chapter.why(step), next?.sentence);
    Lesson.cards.code(this.cards.code, chapter, hides ? -1 : chapter.line(step));
    Lesson.cards.layers(this.cards.layers, chapter.layers, layers, (layer) => this.player.toggleLayer(layer));
    Lesson.cards.legend(this.legend, chapter, predict.isOn, (kind) => this.player.toNext(kind));
    this.timeline.draw(chapter.steps(), chapter.kinds, step, chapter.sentence(step), predict.isOn);
    this.explain(this.cards.now, this.cards.next, this.cards.why);
    const coming = hides ? null : chapter.next(step);
    this.live.textContent = chapter.sentence(step) + (coming ? ` Next: ${coming.sentence}` : "");
  }

  // What had the focus is gone: an answer, given or passed by. Whoever goes by the keyboard goes on from here.
  keepFocus() {
    const answer = this.cards.next.querySelector(".answers button");
    (answer ?? this.controls.querySelector("[data-command=next]")).focus();
  }

  showResult(predict, chapter, step) {
    const text = predict.isOn ? predict.resultText(step, chapter.kinds) : null;
    if (text) this.cards.next.append(Lesson.element("p", {class: "score"}, `${text} ${predict.scoreText()}.`));
    const button = this.controls.querySelector("[data-command=predict]");
    button.setAttribute("aria-pressed", predict.isOn);
  }

  key(event) {
    const pressed = Lesson.keyboard.commandOf(event);
    if (!pressed || this.help.open) return;
    if (pressed.digit && this.player)
      this.player.toggleLayer(pressed.digit);
    else if (this.answerByKey(event.key.toLowerCase()) || this.command(pressed.command))
      event.preventDefault();
    if (pressed.command === "predict") this.cards.next.querySelector(".answers button")?.focus();
  }

  // While a question is asked, the letters of its answers come first.
  answerByKey(letter) {
    if (!this.player?.hidesNext()) return false;
    const found = Object.entries(this.player.chapter.kinds).find(([, kind]) => kind.key === letter);
    if (found) this.player.answer(found[0]);
    return Boolean(found);
  }

  command(name) {
    if (name === "help")
      this.help.showModal();
    else if (name === "theme")
      this.redress(Lesson.theme.isDark() ? "light" : "dark");
    else if (name === "exercise")
      this.goToExercise();
    else if (name === "nextChapter" || name === "backChapter")
      this.goToChapter(name === "nextChapter" ? 1 : -1);
    else if (name === "svg" && this.player)
      this.save();
    else
      return this.player?.command(name) ?? false;
    return true;
  }

  goToChapter(direction) {
    const to = Lesson.chapters[Lesson.chapters.indexOf(this.chapter) + direction];
    if (!to) return;
    Lesson.address.forget();
    window.location.hash = `#${to.name}`;
  }

  // Where a chapter has none, its exercise is to predict.
  goToExercise() {
    const box = this.root().querySelector(".exercise input, .exercise button, textarea");
    if (box) return box.focus();
    if (!this.player) return undefined;
    // In predict mode the reader stays: E may be the letter of an answer, pressed twice.
    if (!this.player.predict.isOn) {
      const step = this.player.openQuestion();
      if (step < 0) return undefined;
      this.player.goTo(step);
      this.player.command("predict");
    }
    return this.cards.next.querySelector(".answers button")?.focus();
  }

  redress(choice) {
    if (choice)
      Lesson.theme.choose(choice);
    else
      Lesson.theme.apply();
    this.draw();
  }

  save() {
    const {chapter, step, layers} = this.player;
    const svg = Lesson.svgOf(this.stage.scene(), chapter.sentence(step), {layers});
    const link = Lesson.element(
        "a",
        {href: URL.createObjectURL(new Blob([svg], {type: "image/svg+xml"})), download: `${chapter.name}-${step}.svg`});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
};
