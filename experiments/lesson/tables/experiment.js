// An experiment of configs/teaching with the table that its runs have given. What its answer claims of the table is
// asked as questions first; what is right is read off the table.
Lesson.Experiment = class {
  constructor(data) { Object.assign(this, data); }

  get name() { return this.file.replace(/^.*\//, "").replace(/\.json$/, ""); }

  // The figure of a reference DATASET|VARIANT|METRIC: {text, numbers, name}; the variant may be "A over B".
  figure(reference) {
    const [dataset, variant, metric, statistic] = reference.split("|");
    const [own, over] = variant.split(" over ");
    const cell = (its) => {
      const row = this.rows.find((other) => other.dataset === dataset && other.variant === its);
      return row.cells[this.metrics.indexOf(metric)];
    };
    const name = `${dataset} with “${own}”: ${metric}`;
    const first = cell(own);
    if (over) {
      const quotient = Lesson.Experiment.median(first.numbers) / Lesson.Experiment.median(cell(over).numbers);
      return {
        text: Lesson.numberText(quotient),
        numbers: [quotient],
        name: `${dataset}: ${metric} with “${own}” over that with “${over}”`,
        metric
      };
    }
    if (!statistic) return {...first, name, dataset, variant: own, metric};
    const {numbers} = first;
    const one = {smallest: numbers[0], largest: numbers[numbers.length - 1]}[statistic] ??
        Lesson.Experiment.median(numbers);
    return {text: Lesson.numberText(one), numbers: [one], name: `${name}, ${statistic} of the runs`, metric};
  }

  static median(numbers) {
    const half = (numbers.length - 1) / 2;
    return (numbers[Math.floor(half)] + numbers[Math.ceil(half)]) / 2;
  }

  // smaller, equal or larger, if all runs agree; else null.
  static compare(a, b) {
    const all = (holds) => a.every((x) => b.every((y) => holds(x, y)));
    if (all((x, y) => x < y)) return "smaller";
    if (all((x, y) => x === y)) return "equal";
    return all((x, y) => x > y) ? "larger" : null;
  }

  // A claim as a question: {question, options, answer, because}, without options where a number is to be typed in.
  // Null where the runs do not agree.
  ask({figure: reference, than}) {
    const figure = this.figure(reference);
    const isFigure = typeof than === "string" && than.startsWith("{");
    if (typeof than === "string" && !isFigure) return this.askText(figure, reference);
    const other = isFigure ? this.figure(than.slice(1, -1)) : {text: String(than), numbers: [than], name: String(than)};
    if (!figure.numbers.length || !other.numbers.length) return isFigure ? null : this.askText(figure, reference);
    const right = Lesson.Experiment.compare(figure.numbers, other.numbers);
    if (!right) return null;
    const because = `${figure.name}: ${figure.text}${isFigure ? `; ${other.name}: ${other.text}` : ""}.`;
    if (!isFigure && figure.numbers.length === 1 && Number.isInteger(figure.numbers[0]) && right === "equal")
      return {question: `${figure.name}, which number?`, answer: () => figure.numbers[0], because: () => because};
    const isBeside = isFigure && figure.dataset && figure.dataset === other.dataset && figure.metric === other.metric;
    const question = isBeside ? `${figure.dataset}: is “${figure.metric}” with “${
                                    figure.variant}” smaller or larger than with “${other.variant}”?` :
                                `${figure.name}; compared with ${other.name}?`;
    return {question, options: ["smaller", "equal", "larger"], answer: () => right, because: () => because};
  }

  askText(figure, reference) {
    const metric = this.metrics.indexOf(reference.split("|")[2]);
    const texts = new Set(this.rows.map((row) => row.cells[metric].text));
    for (const pair of [["true", "false"], ["homeomorphic", "different"]]) {
      if (pair.some((text) => texts.has(text))) pair.forEach((text) => texts.add(text));
    }
    const options = [...texts].filter((text) => !/[(,]/.test(text)).sort();
    if (options.length < 2 || !options.includes(figure.text)) return null;
    const because = `${figure.name}: ${figure.text}.`;
    return {question: `${figure.name}?`, options, answer: () => figure.text, because: () => because};
  }

  // A few questions, of every form that the claims have.
  questions(most = 5) {
    const asked = new Map();
    const times = new Map();
    for (const claim of this.claims) {
      const its = this.ask(claim);
      if (!its || asked.has(its.question)) continue;
      const form = String(its.options);
      times.set(form, (times.get(form) ?? 0) + 1);
      if (times.get(form) <= 3) asked.set(its.question, {...its, claim});
    }
    return [...asked.values()].slice(0, most);
  }
};
