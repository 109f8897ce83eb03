// Checks what a student wrote. It runs in a worker, so that an endless loop costs two seconds and not the page.
Lesson.judge = (() => {
  const kPatience = 2000;  // milliseconds

  const instancesOf = (task, seed) => task.instances(new Lesson.Random(seed));

  // Runs the function on each list of arguments. Kept free of names of the page, because its text is sent to a worker.
  const runAll = (code, name, calls) => {
    const make = new Function(`"use strict";\n${code}\nreturn typeof ${name} === "function" ? ${name} : null;`);
    const solution = make();
    if (!solution) return {error: `there is no function ${name}`};
    const results = [];
    for (const values of calls) {
      try {
        results.push({value: solution(...JSON.parse(JSON.stringify(values)))});
      } catch (error) {
        results.push({error: String(error)});
      }
    }
    return {results};
  };

  const runHere = (code, name, calls) => {
    try {
      return runAll(code, name, calls);
    } catch (error) {
      return {error: String(error)};
    }
  };

  const runInWorker = (code, name, calls, patience = kPatience) => new Promise((resolve) => {
    const text = `onmessage = ({data}) => { let answer; try { answer = (${runAll})(...data); }
      catch (error) { answer = {error: String(error)}; } postMessage(answer); };`;
    const url = URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
    const worker = new Worker(url);
    const finish = (answer) => {
      clearTimeout(timer);
      worker.terminate();
      URL.revokeObjectURL(url);
      resolve(answer);
    };
    const timer = setTimeout(
        () => finish({error: `it did not end within ${patience / 1000} seconds: is there an endless loop?`}), patience);
    worker.onmessage = ({data}) => finish(data);
    worker.onerror = (event) => finish({error: event.message});
    worker.postMessage([code, name, calls]);
  });

  // {passed, total, error} or {passed, total, case}, where the case is the first that is wrong: {index, instance,
  // given, right, error}.
  const compare = (task, instances, answer) => {
    const total = instances.length;
    if (answer.error) return {passed: 0, total, error: answer.error};
    let passed = 0, first = null;
    instances.forEach((instance, index) => {
      const right = task.answer(instance);
      const {value, error} = answer.results[index];
      if (!error && task.isRight(value, right))
        passed += 1;
      else
        first ??= {index, instance, given: value, right, error};
    });
    return {passed, total, case: first};
  };

  const judge = async (task, code, seed, run = runInWorker) => {
    const instances = instancesOf(task, seed);
    return compare(task, instances, await run(code, task.name, instances.map((instance) => instance.arguments)));
  };

  return {judge, instancesOf, runHere, runInWorker};
})();
