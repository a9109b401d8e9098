/** The page's service worker: keeps the page's own files, so that it works without a network, and asks for nothing else.
 * The build names the files, and with them a version: other files make another worker, which replaces this one. */
declare const FLIPFREE_PAGE: { version: string; files: string[] };

interface ExtendableEvent extends Event {
  waitUntil(work: Promise<unknown>): void;
}
interface FetchEvent extends ExtendableEvent {
  request: Request;
  respondWith(response: Promise<Response>): void;
}
interface Scope {
  skipWaiting(): Promise<void>;
  clients: { claim(): Promise<void> };
  addEventListener(type: "install" | "activate", listener: (event: ExtendableEvent) => void): void;
  addEventListener(type: "fetch", listener: (event: FetchEvent) => void): void;
}

const scope = self as unknown as Scope;
const { version, files } = FLIPFREE_PAGE;
const prefix = "flipfree-";
const cacheName = prefix + version;

async function keep(): Promise<void> {
  const cache = await caches.open(cacheName);
  // Asks the server whether what the browser has is still the same.
  await cache.addAll(["./", ...files].map((file) => new Request(file, { cache: "no-cache" })));
  await scope.skipWaiting();
}

async function dropOthers(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(names.filter((one) => one.startsWith(prefix) && one !== cacheName).map((one) => caches.delete(one)));
  await scope.clients.claim();
}

async function answer(request: Request): Promise<Response> {
  const cache = await caches.open(cacheName);
  return (await cache.match(request, { ignoreSearch: true, ignoreVary: true })) ?? fetch(request);
}

scope.addEventListener("install", (event) => event.waitUntil(keep()));
scope.addEventListener("activate", (event) => event.waitUntil(dropOthers()));
scope.addEventListener("fetch", (event) => event.respondWith(answer(event.request)));
