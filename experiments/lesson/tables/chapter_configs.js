// Chapter 11: the laboratory of configs. Each experiment asks first, then shows the table of its runs, which the
// program has made with this page; the errata of the paper say where a reading had to be chosen.
Lesson.ConfigsChapter = class {
  constructor(experiments, errata) {
    Object.assign(this, {name: "configs", title: "11 Configs", errata});
    this.experiments = experiments.map((data) => new Lesson.Experiment(data));
  }

  page() {
    const {element} = Lesson;
    const items =
        [...this.experiments.map(({name, title}) => [name, title]), ["errata", "Errata: what the paper leaves out"]];
    this.links = items.map(([name, title]) => this.linkTo(name, title));
    this.shown = element("div", {class: "experiment"});
    this.show("");
    return element(
        "div", {class: "configs"},
        element(
            "nav", {class: "list", "aria-label": "experiments"},
            element("p", {class: "soft"}, "Ask first; then the table of real runs, made with this page."),
            ...this.links),
        this.shown);
  }

  // On a phone what stands before the colon has to do.
  linkTo(name, title) {
    const {element} = Lesson;
    const at = title.indexOf(":");
    const parts = at < 0 ? [title] : [title.slice(0, at), element("span", {class: "long"}, title.slice(at))];
    return element("a", {href: `#configs/${name}`}, ...parts);
  }

  // `rest` is what follows #configs/ in the address.
  show(rest) {
    const experiment =
        this.experiments.find(({name}) => name === rest) ?? (rest === "errata" ? null : this.experiments[0]);
    const name = experiment ? experiment.name : "errata";
    for (const link of this.links) {
      if (link.getAttribute("href") === `#configs/${name}`)
        link.setAttribute("aria-current", "page");
      else
        link.removeAttribute("aria-current");
    }
    this.shown.replaceChildren(...(experiment ? this.experimentPage(experiment) : this.errataPage()));
  }

  experimentPage(experiment) {
    const {element} = Lesson;
    const questions = experiment.questions();
    const later = element("div", {hidden: true});
    const table = element("button", {onclick: () => this.reveal(later, table)}, "Show the table");
    let left = questions.length;
    const seen = () => {
      left -= 1;
      if (left === 0) table.textContent = "Now show the table";
    };
    const answer = element("details", {}, element("summary", {}, "The answer, compared with these runs"));
    answer.append(...Lesson.markdown(experiment.answer.replace(/^\s*## Answer\n/, "")));
    later.append(this.table(experiment), answer);
    if (Lesson.data.answers) {
      this.reveal(later, table);
      answer.open = true;
    }
    return [
      element("h1", {}, experiment.title), element("p", {class: "sentence"}, experiment.question),
      ...experiment.notes.flatMap((note) => Lesson.markdown(note)), element("h2", {}, "Predict"),
      ...questions.map(
          (question) => (question.options ? Lesson.choice : Lesson.exercise)({...question, title: "", seen})),
      element("p", {}, table), later,
      element(
          "p", {class: "soft"}, "Change it and run it again: ", element("code", {}, `deliso run ${experiment.file}`),
          ". Seconds are those of the machine that made this page.")
    ];
  }

  reveal(later, button) {
    later.hidden = false;
    button.hidden = true;
  }

  table({metrics, rows}) {
    const {element} = Lesson;
    const head =
        element("tr", {}, ...["data set", "variant", ...metrics].map((name) => element("th", {scope: "col"}, name)));
    const body = rows.map(
        ({dataset, variant, cells}) => element(
            "tr", {}, ...[dataset, variant, ...cells.map(({text}) => text)].map((text) => element("td", {}, text))));
    return Lesson.scrolled(element("table", {class: "figures"}, head, ...body), "the runs");
  }

  // Each entry tells where and what; what was seen, and what is done here, after the reader has decided.
  errataPage() {
    const {element} = Lesson;
    const [, ...entries] = this.errata.split(/^## /m);
    const parts = entries.map((entry) => {
      const [title] = entry.split("\n", 1);
      const text = entry.slice(title.length);
      const at = text.indexOf("**Seen.**");
      const hidden = element("details", {}, element("summary", {}, "What can be seen, and what this program does"));
      hidden.append(...Lesson.markdown(at < 0 ? "" : text.slice(at)));
      hidden.open = Lesson.data.answers;
      return element(
          "section", {}, element("h2", {}, title), ...Lesson.markdown(at < 0 ? text : text.slice(0, at)), hidden);
    });
    return [
      element("h1", {}, "Errata: what the paper leaves out"),
      element(
          "p", {},
          "What a reader runs into who writes the program. Before you open an entry, say what you would have done, " +
              "and which experiment would decide."),
      ...parts
    ];
  }
};

Lesson.preparations = [
  ...(Lesson.preparations ?? []),
  () => {
    const {experiments, errata} = Lesson.data;
    if (experiments) Lesson.chapters.push(new Lesson.ConfigsChapter(experiments, errata));
  }
];
