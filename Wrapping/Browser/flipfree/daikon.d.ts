/** What is used of daikon, which has no types of its own. */
declare module "daikon" {
  interface DicomImage {
    /** Of all frames, decompressed. */
    getRawData(): ArrayBuffer;
  }
  const daikon: { Series: { parseImage(view: DataView): DicomImage | null } };
  export default daikon;
}
