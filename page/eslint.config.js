import js from "@eslint/js";
import tseslint from "typescript-eslint";

// Names from files become text, never HTML.
const html = "Text from files never becomes HTML: use h() of src/ui/dom.ts.";

export default tseslint.config(
  { ignores: ["dist", "node_modules"] },
  js.configs.recommended,
  {
    files: ["src/**/*.ts"],
    extends: [...tseslint.configs.strictTypeChecked],
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    rules: {
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      "@typescript-eslint/no-confusing-void-expression": ["error", { ignoreArrowShorthand: true }],
      "max-lines": ["error", 400],
      "no-restricted-properties": [
        "error",
        ...["innerHTML", "outerHTML", "insertAdjacentHTML"].map((property) => ({ property, message: html })),
      ],
      "no-restricted-globals": ["error", "eval"],
      "no-restricted-syntax": [
        "error",
        { selector: "Identifier[name=/^urdd_/]", message: "wasm/npm/module.mjs alone calls what a module exports." },
      ],
    },
  },
  {
    files: ["**/*.mjs", "eslint.config.js"],
    languageOptions: {
      globals: {
        process: "readonly",
        console: "readonly",
        URL: "readonly",
        Buffer: "readonly",
        setTimeout: "readonly",
        performance: "readonly",
        document: "readonly",
        fetch: "readonly",
        window: "readonly",
        location: "readonly",
      },
    },
  },
);
