// Starts a page in one file: unpacks its program, whose hash the page's policy knows.
(async () => {
  const packed = Uint8Array.from(atob(document.getElementById("app.js").textContent), (c) => c.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const script = document.createElement("script");
  script.textContent = await new Response(unpacked).text();
  document.body.append(script);
})();
