// A server on loopback, and Chromium with the page: what it asks for, from whom, and whether its policy held.
import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join } from "node:path";

const { chromium } = createRequire(join(process.env.FLIPFREE_BROWSER_SOURCE, "package.json"))("playwright-core");

/** Python's own, as serve.sh, on a port that is free. */
export async function serve(folder) {
  const server = spawn("python3", ["-u", "-m", "http.server", "0", "--bind", "127.0.0.1", "--directory", folder]);
  const line = await new Promise((resolve, reject) => {
    server.stdout.once("data", resolve);
    server.once("exit", () => reject(new Error("no server")));
  });
  const paths = [];
  server.stderr.on("data", (text) => paths.push(...[...`${text}`.matchAll(/"[A-Z]+ (\S+) HTTP/g)].map((match) => match[1])));
  const stop = () =>
    new Promise((resolve) => {
      server.once("exit", resolve);
      server.kill();
    });
  return { address: `http://127.0.0.1:${`${line}`.match(/port (\d+)/)[1]}/`, paths, stop };
}

/** What Chromium asks for on its own account: the time, updates, and how to fill in forms. */
const ofChromium = /^(https?:\/\/)?[\w-]+(\.[\w-]+)*\.(google|googleapis|gvt1)\.com[:/]/;

/** A proxy for all addresses but this machine's: writes them down and answers none. */
async function startProxy(asked) {
  const take = ({ url }) => {
    if (!ofChromium.test(url)) {
      asked.push(url);
    }
  };
  const proxy = createServer((request, response) => {
    take(request);
    response.writeHead(403).end();
  });
  proxy.on("connect", (request, socket) => {
    take(request);
    socket.on("error", () => {}); // Chromium may hang up first
    socket.end("HTTP/1.1 403 Forbidden\r\n\r\n");
  });
  await new Promise((resolve) => proxy.listen(0, "127.0.0.1", resolve));
  return proxy;
}

export async function startChromium() {
  const outside = []; // what was asked of other addresses
  const faults = []; // of the page, among them violations of its policy
  const proxy = await startProxy(outside);
  const browser = await chromium.launch({
    executablePath: process.env.FLIPFREE_CHROMIUM,
    args: [`--proxy-server=127.0.0.1:${proxy.address().port}`, "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
  const openPage = async (address, options = {}) => {
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, acceptDownloads: true, colorScheme: "dark", ...options });
    // What the page and its workers ask for is known before the proxy is asked.
    context.on("request", (request) => {
      if (!request.url().startsWith(address) && !/^(blob|data):/.test(request.url())) {
        outside.push(request.url());
      }
    });
    const page = await context.newPage();
    page.on("console", (message) => {
      if (/Content Security Policy/.test(message.text())) {
        faults.push(message.text());
      }
    });
    page.on("pageerror", (error) => faults.push(`${error}`));
    await page.goto(address);
    await page.waitForSelector("html[data-ready]", { timeout: 60_000 });
    return page;
  };
  const close = async () => {
    await browser.close();
    proxy.close();
  };
  return { browser, openPage, outside, faults, close };
}
