/** Where results come from: the session that travels with a surface. */

/** Names that a result's own text leaves open. */
export interface OriginNames {
  /** Of the image's file or folder. */
  image?: string;
  organ?: string;
  /** As #ffd24a. */
  color?: string;
  /** Of the file of the label map that the organ started from. */
  startLabels?: string;
}

/** The provenance with the names. */
export function namedProvenance(provenance: string, names: OriginNames): string {
  const session = JSON.parse(provenance);
  const [organ] = session.organs;
  session.image.name = names.image ?? session.image.name;
  organ.name = names.organ ?? organ.name;
  organ.color = names.color ?? organ.color;
  if (organ.startLabels) {
    organ.startLabels.name = names.startLabels ?? organ.startLabels.name;
  }
  return JSON.stringify(session);
}
