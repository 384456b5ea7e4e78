-- A real Neovim with `urdd lsp`: diagnostics, hover, definition, completion, fixes, and the end. Run by checks/editors/run.
-- Needs Neovim 0.7 or later. arguments: URDD (the program), FILE (a copy of arm.urdf).

local program, file = os.getenv("URDD"), os.getenv("FILE")
-- A message of 0.8 and later that asks for a key would wait forever.
vim.opt.shortmess:append("I")

local function check(is_right, what, seen)
  if not is_right then
    io.stderr:write("neovim: " .. what .. ": " .. vim.inspect(seen) .. "\n")
    vim.cmd("cquit 1")
  end
end

local function wait(what, is_there)
  local seen
  local arrived = vim.wait(30000, function()
    seen = is_there()
    return seen ~= nil and seen ~= false
  end, 20)
  check(arrived, "waited in vain for " .. what, seen)
  return seen
end

vim.cmd("edit " .. vim.fn.fnameescape(file))
local buffer = vim.api.nvim_get_current_buf()
local exit_status
local client = vim.lsp.start_client({
  name = "urdd",
  cmd = { program, "lsp" },
  root_dir = vim.fn.fnamemodify(file, ":h"),
  init_options = { xacro = false, packagePaths = {} },
  on_exit = function(status)
    exit_status = status
  end,
})
check(client, "the server did not start", client)
vim.lsp.buf_attach_client(buffer, client)

local function with_code(code)
  local found = vim.tbl_filter(function(one)
    local lsp = one.user_data and one.user_data.lsp
    return (one.code or (lsp and lsp.code)) == code
  end, vim.diagnostic.get(buffer))
  return #found > 0 and found or nil
end

local function ask(method, parameters)
  local answers, failure = vim.lsp.buf_request_sync(buffer, method, parameters, 30000)
  check(answers and answers[client] and not answers[client].error, method, failure or answers)
  return answers[client].result
end

local function at(pattern, after)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, -1, false)) do
    local start = line:find(pattern, 1, true)
    if start then
      -- In UTF-16, where characters before it need more than one byte.
      local column = vim.str_utfindex(line, start - 1 + after)
      local _, units = vim.str_utfindex(line, start - 1 + after)
      return {
        textDocument = { uri = vim.uri_from_bufnr(buffer) },
        position = { line = number - 1, character = units or column },
      }
    end
  end
  check(false, "the file does not contain", pattern)
end

-- Findings, with their places: one of the text, one about shapes.
local found = wait("LNT012", function() return with_code("LNT012") end)
check(found[1].lnum == 16 and found[1].col == 10, "the place of LNT012", found)
check(found[1].severity == vim.diagnostic.severity.WARN, "the severity of LNT012", found)
wait("LNT002", function() return with_code("LNT002") end)

local hover = ask("textDocument/hover", at('link="upper', 8))
check(hover.contents.value:find("mass: 2.5 kg", 1, true), "hover", hover)

local place = ask("textDocument/definition", at('child link="upper', 14))
check(place.range.start.line == 3 and place.uri == vim.uri_from_bufnr(buffer), "definition", place)

local items = ask("textDocument/completion", at('parent link="base', 13))
check(#items == 2 and items[1].label == "base", "completion", items)

local symbols = ask("textDocument/documentSymbol", { textDocument = { uri = vim.uri_from_bufnr(buffer) } })
check(symbols[1].name == "base" and symbols[1].children[1].children[1].name == "upper", "symbols", symbols)

-- A fix, applied as a person would.
local parameters = at("<axis", 8)
parameters.range = { start = parameters.position, ["end"] = parameters.position }
parameters.context = { diagnostics = {} }
local actions = ask("textDocument/codeAction", parameters)
local fix = vim.tbl_filter(function(one) return one.kind == "quickfix" end, actions)[1]
check(fix, "a fix", actions)
vim.lsp.util.apply_workspace_edit(fix.edit, "utf-16")
wait("the end of LNT012", function() return with_code("LNT012") == nil end)

-- Typed with an error, and undone.
vim.api.nvim_buf_set_lines(buffer, 4, 4, false, { "  <link na" })
wait("the error", function()
  local errors = vim.diagnostic.get(buffer, { severity = vim.diagnostic.severity.ERROR })
  return #errors > 0
end)
hover = ask("textDocument/hover", at('link="upper', 8))
check(hover.contents.value:find("mass: 2.5 kg", 1, true), "hover while half typed", hover)
vim.api.nvim_buf_set_lines(buffer, 4, 5, false, {})
wait("the end of the error", function()
  return #vim.diagnostic.get(buffer, { severity = vim.diagnostic.severity.ERROR }) == 0
end)

vim.lsp.stop_client(client)
wait("the end of the server", function() return exit_status ~= nil end)
check(exit_status == 0, "the server's exit status", exit_status)
print("neovim: all is right")
vim.cmd("qall!")
