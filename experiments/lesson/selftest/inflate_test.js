// The unpacking of the page's data, against that of the browser.
(() => {
  const {test, check, equal} = Lesson.selftest;

  const through = async (bytes, stream) =>
      new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

  test("what the browser packs is unpacked", async () => {
    if (typeof CompressionStream === "undefined") return;
    const random = new Lesson.Random(3);
    const kinds = {
      nothing: () => [],
      equal: (n) => Array(n).fill(7),
      random: (n) => Array.from({length: n}, () => random.below(256)),
      digits: (n) => Array.from({length: n}, () => 48 + random.below(10)),
      repeated: (n) => Array.from({length: n}, (_, i) => (i * i) % 97),
    };
    for (const [name, make] of Object.entries(kinds)) {
      for (const length of [1, 300, 70000]) {
        const bytes = Uint8Array.from(make(length));
        const packed = await through(bytes, new CompressionStream("deflate"));
        const unpacked = Lesson.inflate(packed, bytes.length);
        check(bytes.every((byte, i) => byte === unpacked[i]), `${name}, ${length} bytes`);
      }
    }
  });

  test("the data of the page are what the browser makes of them", async () => {
    if (typeof DecompressionStream === "undefined") return;
    const {textContent} = document.getElementById("lesson-data");
    const packed = Uint8Array.from(atob(textContent), (c) => c.charCodeAt(0));
    const text = new TextDecoder().decode(await through(packed, new DecompressionStream("deflate")));
    equal(JSON.stringify(JSON.parse(text)) === JSON.stringify(Lesson.data), true, "data");
  });

  test("damaged data are refused", () => {
    let message = "";
    try {
      Lesson.inflate(Uint8Array.from([120, 156, 3, 0, 0, 0, 0, 1]), 5);
    } catch (error) {
      message = error.message;
    }
    check(message.includes("damaged"), message);
  });
})();
