/** Parameters by name: the kernels' are MaximumIterations, the package's maximumIterations. */
import { FlipFreeError, type Parameters } from "./types.js";

export interface KernelParameter {
  name: string;
  type: "boolean" | "integer" | "real";
  values: number[];
}

/** MaximumIterations as maximumIterations. */
export function packageName(kernelName: string): string {
  return kernelName.charAt(0).toLowerCase() + kernelName.slice(1);
}

/** What the kernels take for parameters: an array of numbers each, under their own names. */
export function kernelValues(parameters: Parameters, known: KernelParameter[]): Record<string, number[]> {
  const values: Record<string, number[]> = {};
  for (const [name, value] of Object.entries(parameters)) {
    if (value === undefined) {
      continue;
    }
    const parameter = known.find((candidate) => packageName(candidate.name) === name);
    if (!parameter) {
      const names = known.map((candidate) => packageName(candidate.name));
      throw new FlipFreeError(`There is no parameter ${name}; there are ${names.join(", ")}`);
    }
    const numbers = (Array.isArray(value) ? value : [value]).map(Number);
    if (numbers.length !== parameter.values.length) {
      throw new FlipFreeError(`${name}: give ${parameter.values.length} numbers, not ${numbers.length}`);
    }
    values[parameter.name] = numbers;
  }
  return values;
}

/** The other way round. */
export function packageValues(known: KernelParameter[]): Parameters {
  const parameters: Parameters = {};
  for (const { name, type, values } of known) {
    const plain = type === "boolean" ? values.map(Boolean) : values;
    parameters[packageName(name)] = plain.length === 1 ? plain[0] : (plain as number[]);
  }
  return parameters;
}

/** The kernels' messages name quantities in braces; this says them in the package's words. The first letter becomes a capital. */
export function wordMessage(message: string, known: KernelParameter[]): string {
  const names = new Map(known.map((parameter) => [parameter.name, packageName(parameter.name)]));
  names.set("SeedCenter", "the seed's center").set("SeedRadius", "the seed's radius");
  names.set("Labels", "only");
  names.set("AddInsidePoint", "an inside point at").set("AddOutsidePoint", "an outside point at");
  const worded = message.replace(/\{\{|\}\}|\{([^{}]+)\}/g, (part, quantity?: string) =>
    quantity === undefined ? part[0] : (names.get(quantity) ?? quantity),
  );
  return worded.charAt(0).toUpperCase() + worded.slice(1);
}
