/** Bytes of files, packed by gzip or zlib. */
import { Inflate, type Data } from "pako";

export const isPacked = async (file: Blob): Promise<boolean> => {
  return hasMark(new Uint8Array(await file.slice(0, 2).arrayBuffer()), 0);
};

const hasMark = (bytes: Uint8Array, at: number): boolean => bytes[at] === 0x1f && bytes[at + 1] === 0x8b;

/** What pako keeps of a stream, beyond its declared types. */
interface PakoStream {
  strm: { next_in: number; avail_in: number; total_in: number; output: Uint8Array; next_out: number; avail_out: number };
}

/** Reads a file from its beginning on, a part at a time. */
export class InflatedFile {
  private inflate?: Inflate;
  private hasEnded = false; // the stream, or a member of gzip
  private parts: Uint8Array[] = [];
  private available = 0;
  private place = 0;

  constructor(
    private readonly file: Blob,
    packed: boolean,
  ) {
    if (packed) {
      this.inflate = this.newStream();
    }
  }

  /** So many bytes, or fewer at the end or where the stream breaks off. */
  async read(size: number): Promise<Uint8Array> {
    while (this.available < size && (await this.more())) {
      // goes on
    }
    const bytes = new Uint8Array(Math.min(size, this.available));
    for (let filled = 0; filled < bytes.length; ) {
      const [part] = this.parts;
      const taken = part.subarray(0, bytes.length - filled);
      bytes.set(taken, filled);
      filled += taken.length;
      this.parts[0] = part.subarray(taken.length);
      if (this.parts[0].length === 0) {
        this.parts.shift();
      }
    }
    this.available -= bytes.length;
    return bytes;
  }

  /** Past so many bytes. */
  async skip(size: number): Promise<void> {
    for (let left = size; left > 0; ) {
      const { length } = await this.read(Math.min(left, partSize));
      left = length > 0 ? left - length : 0;
    }
  }

  /** Past the ends of so many lines, as they are stored; before anything is read. */
  async skipLines(lines: number): Promise<void> {
    for (let left = lines; left > 0 && this.place < this.file.size; ) {
      const part = await this.stored();
      let begin = 0;
      while (left > 0 && begin < part.length) {
        const end = part.indexOf(lineEnd, begin);
        left -= end < 0 ? 0 : 1;
        begin = end < 0 ? part.length : end + 1;
      }
      this.place += begin;
    }
  }

  /** All that follows. */
  async rest(): Promise<Uint8Array> {
    while (await this.more()) {
      // goes on
    }
    return this.read(this.available);
  }

  /** Whether the stream is whole, once it is read to its end. */
  async endsProperly(): Promise<boolean> {
    while (this.inflate && !this.hasEnded && (await this.more())) {
      this.parts = [];
      this.available = 0;
    }
    return !this.inflate || (this.hasEnded && this.inflate.err === 0);
  }

  /** The part of the file that comes next. */
  private async stored(): Promise<Uint8Array> {
    return new Uint8Array(await this.file.slice(this.place, this.place + partSize).arrayBuffer());
  }

  private newStream(): Inflate {
    const stream = new Inflate();
    stream.onData = (part) => this.keep(part as Uint8Array);
    stream.onEnd = (status) => {
      stream.err = status as typeof stream.err;
      this.hasEnded = status === 0;
    };
    this.hasEnded = false;
    return stream;
  }

  private keep(part: Uint8Array): void {
    this.parts.push(part);
    this.available += part.length;
  }

  /** False at the end. */
  private async more(): Promise<boolean> {
    if (this.place >= this.file.size || (this.inflate && this.inflate.err !== 0)) {
      return false;
    }
    const part = await this.stored();
    this.place += part.length;
    if (this.inflate) {
      if (this.hasEnded && !hasMark(part, 0)) {
        this.place = this.file.size;
        return false;
      }
      this.inflate = this.hasEnded ? this.newStream() : this.inflate;
      this.inflate.push(part as Data, false);
      this.endAtPadding(this.inflate, part);
    } else {
      this.keep(part);
    }
    return true;
  }

  /** What stands behind a member of gzip and is none is padding; but pako inflates whatever does not begin with a zero. */
  private endAtPadding(inflate: Inflate, part: Uint8Array): void {
    const { strm } = inflate as unknown as PakoStream;
    const begin = strm.next_in - strm.total_in; // of the last member, if it is in this part
    const isCut = begin + 1 === part.length && this.place < this.file.size; // in the middle of a mark
    if (begin > 0 && !isCut && !hasMark(part, begin)) {
      if (inflate.err !== 0 || strm.avail_out > 0) {
        this.keep(strm.output.subarray(0, strm.next_out));
      }
      inflate.err = 0;
      this.hasEnded = true;
      this.place = this.file.size;
    } else if (this.hasEnded && strm.avail_in > 0) {
      this.place = this.file.size;
    }
  }
}

const partSize = 1 << 20;
const lineEnd = 10;

/** A file packed by gzip. */
export async function packed(parts: BlobPart[]): Promise<Blob> {
  const stream = new Blob(parts).stream().pipeThrough(new CompressionStream("gzip"));
  return new Blob([await new Response(stream).arrayBuffer()], { type: "application/gzip" });
}
